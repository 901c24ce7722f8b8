#pragma once

#include <string>
#include <vector>

namespace lift_slam::training {

// Words in one text, separated by blanks; a blank or backslash within a word has a backslash before
// it. An empty word is lost.
std::string JoinWords(const std::vector<std::string>& words);
std::vector<std::string> SplitWords(const std::string& text);

}  // namespace lift_slam::training

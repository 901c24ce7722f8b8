#include "training/word_list.h"

#include <cctype>

namespace lift_slam::training {
namespace {

bool IsBlank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string JoinWords(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ' ';
    for (const char c : word) {
      if (IsBlank(c) || c == '\\') text += '\\';
      text += c;
    }
  }
  return text;
}

std::vector<std::string> SplitWords(const std::string& text) {
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (IsBlank(text[i])) {
      if (!words.back().empty()) words.emplace_back();
      continue;
    }
    if (text[i] == '\\' && i + 1 < text.size()) ++i;
    words.back() += text[i];
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

}  // namespace lift_slam::training

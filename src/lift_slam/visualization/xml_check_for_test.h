#pragma once

#include <string>
#include <string_view>

namespace lift_slam {

// What is wrong with a text that should be well-formed XML (tags nested, attributes quoted and
// unique, entities closed); empty when nothing is. With `html`, void elements such as <img> need
// no end and the text of <script> and <style> is not looked at.
std::string XmlProblem(std::string_view text, bool html = false);

}  // namespace lift_slam

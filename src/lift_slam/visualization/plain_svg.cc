#include "lift_slam/visualization/plain_svg.h"

#include <algorithm>
#include <cctype>

namespace lift_slam {
namespace {

void ReplaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

// "--p0:#30353c" with line breaks around it.
void ReplaceVariable(std::string declaration, std::string& svg) {
  while (!declaration.empty() && std::isspace(static_cast<unsigned char>(declaration.front()))) {
    declaration.erase(0, 1);
  }
  const std::size_t colon = declaration.find(':');
  if (!declaration.starts_with("--") || colon == std::string::npos) return;
  ReplaceAll(svg, "var(" + declaration.substr(0, colon) + ")", declaration.substr(colon + 1));
}

}  // namespace

std::string PlainSvg(std::string svg) {
  constexpr const char* kBeginning = ":root{";
  const std::size_t found = svg.find(kBeginning);
  if (found == std::string::npos) return svg;
  const std::size_t begin = found + std::char_traits<char>::length(kBeginning);
  const std::size_t end = svg.find('}', begin);
  if (end == std::string::npos) return svg;
  const std::string declarations = svg.substr(begin, end - begin);
  for (std::size_t at = 0; at <= declarations.size();) {
    const std::size_t next = std::min(declarations.find(';', at), declarations.size());
    ReplaceVariable(declarations.substr(at, next - at), svg);
    at = next + 1;
  }
  return svg;
}

}  // namespace lift_slam

#include "lift_slam/visualization/xml_check_for_test.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

namespace lift_slam {
namespace {

const std::set<std::string> kVoid = {"meta", "br", "img", "input", "link", "hr"};
const std::set<std::string> kRaw = {"script", "style"};
const std::set<std::string> kEntities = {"amp", "lt", "gt", "quot", "middot"};

bool IsNumber(std::string_view text) {
  return text.size() > 1 && text[0] == '#' &&
         std::all_of(text.begin() + 1, text.end(), [](unsigned char c) { return std::isdigit(c); });
}

// No '>' and no '&' but of an entity in use.
bool GoodText(const std::string& text) {
  if (text.find('>') != std::string::npos) return false;
  for (std::size_t i = text.find('&'); i != std::string::npos; i = text.find('&', i + 1)) {
    const std::size_t end = text.find(';', i);
    if (end == std::string::npos) return false;
    const std::string name = text.substr(i + 1, end - i - 1);
    if (!kEntities.contains(name) && !IsNumber(name)) return false;
  }
  return true;
}

// Name of a start tag; empty when its attributes are malformed or repeated.
std::string TagName(const std::string& inside) {
  const std::size_t end = inside.find_first_of(" \n");
  const std::string name = inside.substr(0, end);
  std::set<std::string> seen;
  for (std::size_t i = name.size(); i < inside.size();) {
    if (inside[i] == ' ' || inside[i] == '\n') {
      ++i;
      continue;
    }
    const std::size_t stop = inside.find_first_of("= \n", i);
    const std::string key = inside.substr(i, stop - i);
    if (!seen.insert(key).second) return {};
    if (stop == std::string::npos || inside[stop] != '=') {
      if (key != "open") return {};  // the one attribute without a value in use
      i += key.size();
      continue;
    }
    const std::size_t close = inside.find('"', stop + 2);
    if (inside.compare(stop, 2, "=\"") != 0 || close == std::string::npos) return {};
    const std::string value = inside.substr(stop + 2, close - stop - 2);
    if (value.size() < 2000 && !GoodText(value)) return {};
    i = close + 1;
  }
  return name;
}

}  // namespace

std::string XmlProblem(std::string_view view, bool html) {
  const std::string text(view);
  std::vector<std::string> open;
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t begin = text.find('<', i);
    if (!GoodText(text.substr(i, begin - i))) return "bad text: " + text.substr(i, 60);
    if (begin == std::string::npos) break;
    const std::size_t end = text.find('>', begin);
    if (end == std::string::npos) return "tag without end: " + text.substr(begin, 60);
    std::string inside = text.substr(begin + 1, end - begin - 1);
    i = end + 1;
    if (inside[0] == '!') continue;
    if (inside[0] == '/') {
      if (open.empty() || open.back() != inside.substr(1)) {
        return "</" + inside.substr(1) + "> closes " + (open.empty() ? "nothing" : open.back());
      }
      open.pop_back();
      continue;
    }
    const bool closed = inside.back() == '/';
    if (closed) inside.pop_back();
    const std::string name = TagName(inside);
    if (name.empty()) return "bad tag: " + inside.substr(0, 80);
    if (closed || (html && kVoid.contains(name))) continue;
    open.push_back(name);
    if (kRaw.contains(name)) {
      i = text.find("</" + name, i);
      if (i == std::string::npos) return "no end of " + name;
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

}  // namespace lift_slam

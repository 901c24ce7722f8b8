#include "lift_slam/visualization/xml_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace lift_slam {
namespace {

// Length of the UTF-8 sequence at the start of `text`; 0 when it is malformed.
std::size_t Utf8Length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80           ? 1
                             : (lead >> 5) == 0x6  ? 2
                             : (lead >> 4) == 0xE  ? 3
                             : (lead >> 3) == 0x1E ? 4
                                                   : 0;
  if (length == 0 || length > text.size() || lead == 0xC0 || lead == 0xC1 || lead > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  }
  if (length == 3) {
    const auto second = static_cast<unsigned char>(text[1]);
    if (lead == 0xE0 && second < 0xA0) return 0;  // overlong
    if (lead == 0xED && second > 0x9F) return 0;  // surrogate
    const auto third = static_cast<unsigned char>(text[2]);
    if (lead == 0xEF && second == 0xBF && third >= 0xBE) return 0;  // no XML character
  }
  if (length == 4) {
    const auto second = static_cast<unsigned char>(text[1]);
    if (lead == 0xF0 && second < 0x90) return 0;  // overlong
    if (lead == 0xF4 && second > 0x8F) return 0;  // above U+10FFFF
  }
  return length;
}

std::string_view EscapeAscii(char c, std::string_view self) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\n':
    case '\t':
      return self;
    default:
      return static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? std::string_view{} : self;
  }
}

}  // namespace

std::string EscapeXml(std::string_view text) {
  std::string out;
  out.reserve(text.size() + 16);
  while (!text.empty()) {
    const std::size_t length = Utf8Length(text);
    if (length == 0) {
      out += "\xEF\xBF\xBD";
      text.remove_prefix(1);
      continue;
    }
    out += length == 1 ? EscapeAscii(text[0], text.substr(0, 1)) : text.substr(0, length);
    text.remove_prefix(length);
  }
  return out;
}

std::string Base64(const void* data, std::size_t size) {
  static constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::string out;
  out.reserve((size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t n = std::min<std::size_t>(3, size - i);
    std::uint32_t block = 0;
    for (std::size_t k = 0; k < 3; ++k) block = block << 8 | (k < n ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) {
      out += k <= n ? kAlphabet[block >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return out;
}

std::string FormatNumber(double value, int digits) {
  if (!std::isfinite(value)) return "n/a";
  const double magnitude = std::abs(value);
  std::string text;
  if (magnitude != 0.0 && (magnitude >= 1e7 || magnitude < 1e-4)) {
    text = fmt::format("{:.{}g}", value, digits);
  } else {
    const int before =
        magnitude < 1.0 ? 0 : static_cast<int>(std::floor(std::log10(magnitude))) + 1;
    // Below one, leading zeros after the point do not count as digits, but no more than 5 decimals.
    const int leading = magnitude > 0.0 && magnitude < 1.0
                            ? static_cast<int>(-std::floor(std::log10(magnitude))) - 1
                            : 0;
    text = fmt::format("{:.{}f}", value, std::clamp(digits - before + leading, 0, 6));
    if (text.find('.') != std::string::npos) {
      text.erase(text.find_last_not_of('0') + 1);
      if (text.back() == '.') text.pop_back();
    }
  }
  if (text[0] == '-') text.replace(0, 1, "\xE2\x88\x92");
  return text == "\xE2\x88\x92"
                 "0"
             ? "0"
             : text;
}

}  // namespace lift_slam

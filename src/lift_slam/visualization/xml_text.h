#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lift_slam {

// Text made safe for the content and the attributes of XML and HTML: & < > " ' become entities,
// control characters are dropped, bytes that are not UTF-8 become U+FFFD.
std::string EscapeXml(std::string_view text);

// Base64 (RFC 4648, with padding) of raw bytes.
std::string Base64(const void* data, std::size_t size);

// A number for people: about `digits` significant digits, no trailing zeros, U+2212 as the minus
// sign, "n/a" when it is not finite.
std::string FormatNumber(double value, int digits = 4);

}  // namespace lift_slam

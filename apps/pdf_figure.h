#pragma once

#include <filesystem>
#include <string>

namespace lift_slam {

enum class PdfOutcome { kWritten, kNoConverter, kFailed };

// An SVG file's text as PDF, by rsvg-convert (Debian's librsvg2-bin), which may not be there. The
// file appears whole or not at all; the same SVG gives the same bytes.
PdfOutcome WritePdf(const std::string& svg, const std::filesystem::path& file);

}  // namespace lift_slam

#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace lift_slam {

// The whole file. ReadLines gives one string a line without line ends (LF or CRLF) and without a
// UTF-8 byte order mark. Throws InputError when the file is missing or cannot be read.
std::vector<std::string> ReadLines(const std::filesystem::path& path);
std::string ReadText(const std::filesystem::path& path);

// Writes a file that appears whole or not at all: `write` fills a new file beside it, which takes
// its place. Links stay, devices are written directly. Throws InputError when it cannot be written.
void WriteFileAtomically(const std::filesystem::path& path,
                         const std::function<void(std::ostream&)>& write);
void WriteTextAtomically(const std::filesystem::path& path, const std::string& text);

// Makes a folder and those above it; nothing when it is there. Throws InputError when it cannot be.
void CreateFolder(const std::filesystem::path& folder);

}  // namespace lift_slam

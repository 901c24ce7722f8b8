#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lift_slam {

// Walks over the lines of an AC3D file, word by word. Every failure is an InputError with file and
// line. The text must outlive this object.
class Ac3dLines {
 public:
  Ac3dLines(std::string_view text, const std::filesystem::path& path);

  // Goes to the next line that is not blank; false at the end of the file.
  bool Next();
  // The same where the file may not end: `what` was expected there.
  void Need(std::string_view what);
  // Skips so many bytes after the current line, and the rest of the line where they end.
  void SkipBytes(std::size_t count);

  // The next word of the line, in quotes or not; empty at the line's end.
  std::string_view Word();
  bool AtEnd();
  float Float(std::string_view what);
  // A whole number of at least 0; decimal, or hexadecimal after 0x.
  int Count(std::string_view what);

  [[noreturn]] void Fail(const std::string& what) const;

 private:
  std::string_view text_;
  const std::filesystem::path& path_;
  std::size_t next_line_ = 0;
  int line_number_ = 0;
  std::string_view rest_;  // of the current line
};

}  // namespace lift_slam

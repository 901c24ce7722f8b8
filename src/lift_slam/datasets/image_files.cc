#include "lift_slam/datasets/image_files.h"

#include <fmt/format.h>

#include <cctype>
#include <system_error>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

std::string LowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool IsVisibleImage(const fs::directory_entry& entry) {
  return !entry.path().filename().string().starts_with('.') && IsImageFile(entry.path()) &&
         !entry.is_directory();
}

// The digits at `begin` without leading zeros.
std::string_view DigitRun(const std::string& text, std::size_t& begin) {
  while (begin < text.size() && text[begin] == '0') ++begin;
  const std::size_t first = begin;
  while (begin < text.size() && IsDigit(text[begin])) ++begin;
  return std::string_view(text).substr(first, begin - first);
}

bool HoldsImage(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (IsVisibleImage(entry)) return true;
  }
  return false;
}

}  // namespace

const std::vector<std::string>& ImageExtensions() {
  static const std::vector<std::string> extensions = {".png", ".jpg",  ".jpeg", ".pgm", ".ppm",
                                                      ".bmp", ".tiff", ".tif",  ".webp"};
  return extensions;
}

const std::vector<std::string>& ImageSubfolders() {
  static const std::vector<std::string> names = {"images", "rgb", "data"};
  return names;
}

bool IsImageFile(const fs::path& file) {
  const auto& known = ImageExtensions();
  return std::find(known.begin(), known.end(), LowerExtension(file)) != known.end();
}

bool NaturalLess(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const std::string_view run_a = DigitRun(a, i), run_b = DigitRun(b, j);
      if (run_a.size() != run_b.size()) return run_a.size() < run_b.size();
      if (run_a != run_b) return run_a < run_b;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  if (i == a.size() && j == b.size()) return a < b;  // "1" and "01"
  return i == a.size();
}

std::vector<fs::path> ListImages(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: no such folder", folder.string()));
  }
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (IsVisibleImage(entry)) names.push_back(entry.path().filename().string());
  }
  if (error) throw InputError(fmt::format("{}: {}", folder.string(), error.message()));
  if (names.empty()) throw InputError(fmt::format("{}: there is no image in it", folder.string()));
  std::sort(names.begin(), names.end(), NaturalLess);
  std::vector<fs::path> files;
  for (const std::string& name : names) files.push_back(folder / name);
  return files;
}

std::optional<fs::path> FindImageFolder(const fs::path& folder) {
  if (HoldsImage(folder)) return folder;
  for (const std::string& name : ImageSubfolders()) {
    if (HoldsImage(folder / name)) return folder / name;
  }
  return std::nullopt;
}

std::optional<std::int64_t> ImageNumber(const fs::path& file) {
  return ParseIndex(file.stem().string());
}

bool IsWholeJpeg(const std::string& data) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(data[i]); };
  if (data.size() < 3 || byte(0) != 0xFF || byte(1) != 0xD8 || byte(2) != 0xFF) return true;
  std::size_t position = 2;
  while (true) {
    // A marker starts with 0xFF; stuffed zeros and restart markers belong to the compressed data.
    position = data.find('\xFF', position);
    if (position == std::string::npos || position + 1 >= data.size()) return false;
    const unsigned char marker = byte(position + 1);
    if (marker == 0xD9) return true;
    if (marker == 0xFF) {
      ++position;
    } else if (marker == 0x00 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) {
      position += 2;
    } else {
      if (position + 3 >= data.size()) return false;
      position += 2 + (std::size_t{byte(position + 2)} << 8 | byte(position + 3));
      if (position >= data.size()) return false;
    }
  }
}

std::optional<GrayImage> ReadWholeImage(const fs::path& file, std::string* why) {
  const auto refuse = [&](const char* reason) -> std::optional<GrayImage> {
    if (why != nullptr) *why = file.string() + ": " + reason;
    return std::nullopt;
  };
  const std::string extension = LowerExtension(file);
  try {
    if ((extension == ".jpg" || extension == ".jpeg") && fs::is_regular_file(file) &&
        !IsWholeJpeg(ReadText(file))) {
      return refuse("the file is cut off");
    }
    return ReadGrayImage(file, why);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return refuse("cannot be read");  // no permission, or a kind of pixel that is not supported
  }
}

}  // namespace lift_slam

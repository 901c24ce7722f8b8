#include <fmt/format.h>

#include <sstream>

#include "lift_slam/datasets/keyed_file.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

// Walks the tags of an XML text and keeps the text of each element under the path of its names.
class XmlFlattener {
 public:
  XmlFlattener(const std::string& text, KeyedFile& file) : text_(text), file_(file) {}

  void Run() {
    while (position_ < text_.size()) {
      const std::size_t tag = std::min(text_.find('<', position_), text_.size());
      AddText(text_.substr(position_, tag - position_));
      if (tag == text_.size()) break;
      position_ = tag;
      if (text_.compare(tag, 4, "<!--") == 0) {
        SkipPast("-->");
      } else if (text_.compare(tag, 2, "<?") == 0) {
        SkipPast("?>");
      } else {
        ReadTag();
      }
    }
    if (!names_.empty()) Fail(fmt::format("element '{}' is not closed", names_.back()));
    if (file_.entries_.empty()) Fail("it has no elements");
  }

 private:
  void ReadTag() {
    const std::size_t begin = position_ + 1;
    SkipPast(">");
    const std::string tag = text_.substr(begin, position_ - 1 - begin);
    if (tag.starts_with('/')) {
      if (names_.empty() || tag.substr(1) != names_.back()) {
        Fail(fmt::format("unexpected end of element '{}'", tag.substr(1)));
      }
      names_.pop_back();
    } else if (!tag.ends_with('/')) {
      names_.push_back(tag.substr(0, tag.find_first_of(" \t\r\n")));
    }
  }

  void AddText(const std::string& text) {
    std::istringstream words(text);
    std::string key;
    for (std::size_t i = 1; i < names_.size(); ++i) key += (i > 1 ? "/" : "") + names_[i];
    for (std::string word; words >> word;) {
      if (key.empty()) Fail("text outside the elements");
      KeyedFile::Entry& entry = file_.entries_[key];
      if (entry.line == 0) entry.line = Line();
      entry.values.push_back(std::move(word));
    }
  }

  void SkipPast(std::string_view mark) {
    const std::size_t found = text_.find(mark, position_);
    if (found == std::string::npos) Fail(fmt::format("'{}' is missing", mark));
    position_ = found + mark.size();
  }

  int Line() const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(position_);
    return 1 + static_cast<int>(std::count(text_.begin(), end, '\n'));
  }

  [[noreturn]] void Fail(std::string_view what) const {
    throw InputError(fmt::format("{}:{}: no valid XML: {}", file_.source_, Line(), what));
  }

  const std::string& text_;
  KeyedFile& file_;
  std::size_t position_ = 0;
  std::vector<std::string> names_;
};

KeyedFile KeyedFile::ReadXml(const std::filesystem::path& path) {
  KeyedFile file;
  file.source_ = path.string();
  std::string text = ReadText(path);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  XmlFlattener(text, file).Run();
  return file;
}

}  // namespace lift_slam

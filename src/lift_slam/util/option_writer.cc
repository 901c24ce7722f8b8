#include "lift_slam/util/option_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lift_slam/util/option_paths.h"

namespace lift_slam {
namespace {

constexpr std::size_t kLineWidth = 100;

// Shortest text that reads back as the same number, with a point to show its type.
std::string DoubleText(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

// A YAML text in double quotes.
std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

class YamlWriter final : public OptionVisitor {
 public:
  void Field(std::string_view name, bool& value, std::string_view comment) override {
    Write(name, value ? "true" : "false", comment);
  }
  void Field(std::string_view name, int& value, std::string_view comment) override {
    Write(name, std::to_string(value), comment);
  }
  void Field(std::string_view name, double& value, std::string_view comment) override {
    Write(name, DoubleText(value), comment);
  }
  void Field(std::string_view name, std::string& value, std::string_view comment) override {
    Write(name, Quoted(value), comment);
  }
  void Choice(std::string_view name, int& index, std::span<const std::string_view> names,
              std::string_view comment) override {
    Write(name, names[static_cast<std::size_t>(index)],
          fmt::format("{}{}one of: {}", comment, comment.empty() ? "" : "; ",
                      fmt::join(names, ", ")));
  }

  std::string Take() { return std::move(text_); }

 protected:
  void BeginGroup(std::string_view name, std::string_view comment) override {
    if (!text_.empty()) text_ += '\n';
    WriteComment(comment);
    text_ += fmt::format("{}{}:\n", Indent(), name);
    place_.Enter(name);
  }
  void EndGroup() override { place_.Leave(); }

 private:
  std::string Indent() const { return std::string(2 * place_.depth(), ' '); }

  void Write(std::string_view name, std::string_view value, std::string_view comment) {
    WriteComment(comment);
    text_ += fmt::format("{}{}: {}\n", Indent(), name, value);
  }

  // Comment lines, broken between words.
  void WriteComment(std::string_view comment) {
    const std::string start = Indent() + "#";
    std::string line = start;
    while (!comment.empty()) {
      const std::size_t end = std::min(comment.find_first_of(" \n"), comment.size());
      const std::string_view word = comment.substr(0, end);
      comment.remove_prefix(std::min(end + 1, comment.size()));
      if (line.size() + 1 + word.size() > kLineWidth && line != start) {
        text_ += line + '\n';
        line = start;
      }
      if (!word.empty()) (line += ' ') += word;
    }
    if (line != start) text_ += line + '\n';
  }

  OptionPlace place_;
  std::string text_;
};

}  // namespace

std::string OptionsToYaml(const OptionRoot& root) {
  YamlWriter writer;
  root(writer);
  return writer.Take();
}

}  // namespace lift_slam

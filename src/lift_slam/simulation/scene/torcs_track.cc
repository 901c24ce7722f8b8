#include "lift_slam/simulation/scene/torcs_track.h"

#include <fmt/format.h>

#include <pugixml.hpp>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace fs = std::filesystem;
namespace {

// TORCS's parameter files: <section name=...> with <attnum name= val=> and <attstr name= val=>.
class TrackXml {
 public:
  explicit TrackXml(const fs::path& path) : path_(path) {
    const std::string text = ReadText(path);
    const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
    if (!result) {
      const auto end = text.begin() + std::min<std::ptrdiff_t>(result.offset, std::ssize(text));
      throw InputError(fmt::format("{}:{}: no valid XML: {}", path.string(),
                                   1 + std::count(text.begin(), end, '\n'), result.description()));
    }
  }

  std::string Text(const char* section, const char* name) const {
    return Find(section, "attstr", name).attribute("val").as_string();
  }

  void Number(const char* section, const std::string& name, float& value) const {
    const pugi::xml_node node = Find(section, "attnum", name.c_str());
    if (!node) return;
    const std::string text = node.attribute("val").as_string();
    const std::optional<double> number = ParseDouble(text);
    if (!number || !std::isfinite(*number)) {
      throw InputError(fmt::format("{}: {}/{}: expected a number, found '{}'", path_.string(),
                                   section, name, text));
    }
    value = static_cast<float>(*number);
  }

  void Vector(const std::string& name, const char* letters, Eigen::Vector3f& value) const {
    for (int i = 0; i < 3; ++i) Number("Graphic", name + ' ' + letters[i], value[i]);
  }

 private:
  pugi::xml_node Find(const char* section, const char* kind, const char* name) const {
    const pugi::xml_node root = document_.child("params");
    return root.find_child_by_attribute("section", "name", section)
        .find_child_by_attribute(kind, "name", name);
  }

  const fs::path& path_;
  pugi::xml_document document_;
};

}  // namespace

TorcsTrack ReadTorcsTrack(const fs::path& folder) {
  TorcsTrack track;
  track.folder = folder;
  track.name = fs::weakly_canonical(folder).filename().string();
  const fs::path path = folder / (track.name + ".xml");
  const TrackXml xml(path);
  track.category = xml.Text("Header", "category");
  track.title = xml.Text("Header", "name");
  track.author = xml.Text("Header", "author");
  track.description = xml.Text("Header", "description");
  const std::string mesh = xml.Text("Graphic", "3d description");
  if (mesh.empty()) {
    throw InputError(
        fmt::format("{}: Graphic/3d description: expected a mesh file", path.string()));
  }
  track.mesh = folder / mesh;
  track.background_picture = xml.Text("Graphic", "background image");
  float type = 0.0F;
  xml.Number("Graphic", "background type", type);
  track.background_type = static_cast<int>(type);
  xml.Vector("background color", "RGB", track.background_color);
  xml.Vector("ambient color", "RGB", track.ambient);
  xml.Vector("diffuse color", "RGB", track.diffuse);
  xml.Vector("light position", "xyz", track.light_position);
  return track;
}

}  // namespace lift_slam

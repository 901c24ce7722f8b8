#include "lift_slam/simulation/scene/ac3d_reader.h"

#include <fmt/format.h>

#include <cctype>

#include "lift_slam/simulation/scene/ac3d_lines.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

constexpr int kMaxDepth = 200;
constexpr std::string_view kNoTexture = "empty_texture_no_mapping";  // TORCS's word for none

// file_from_object, y up.
struct Placement {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();
};

Eigen::Vector3f ZUp(const Eigen::Vector3f& v) { return {v.x(), -v.z(), v.y()}; }

class Ac3dParser {
 public:
  Ac3dParser(std::string_view text, const std::filesystem::path& path)
      : lines_(text, path), counts_are_exact_(path.extension() != ".acc") {}

  Ac3dModel Parse() {
    if (!lines_.Next() || !lines_.Word().starts_with("AC3D")) {
      lines_.Fail("expected an AC3D file, whose first line starts with AC3D");
    }
    while (lines_.Next()) {
      const std::string_view word = lines_.Word();
      if (word == "MATERIAL") {
        ReadMaterial();
      } else if (word == "OBJECT") {
        ReadObject(Placement(), 0);
      } else {
        lines_.Fail(fmt::format("expected MATERIAL or OBJECT, found '{}'", word));
      }
    }
    return std::move(model_);
  }

 private:
  // What an object says before its children.
  struct Scope {
    Ac3dObject object;
    Placement own;
    Eigen::Vector2f texture_repeat = {1.0F, 1.0F};
    Eigen::Vector2f texture_offset = {0.0F, 0.0F};
    bool hidden = false;
  };

  Eigen::Vector3f ReadVector(std::string_view what) {
    Eigen::Vector3f vector;
    for (int i = 0; i < 3; ++i) vector[i] = lines_.Float(what);
    return vector;
  }

  void ReadMaterial() {
    Ac3dMaterial material;
    lines_.Word();  // the name
    for (std::string_view key = lines_.Word(); !key.empty(); key = lines_.Word()) {
      if (key == "rgb") material.color = ReadVector("rgb");
      if (key == "amb") material.ambient = ReadVector("amb");
      if (key == "emis") material.emission = ReadVector("emis");
      if (key == "trans") material.transparency = lines_.Float("trans");
    }
    model_.materials.push_back(material);
  }

  void ReadObject(const Placement& parent, int depth) {
    if (depth > kMaxDepth) lines_.Fail(fmt::format("objects nested deeper than {}", kMaxDepth));
    Scope scope;
    for (;;) {
      lines_.Need("'kids'");
      const std::string_view key = lines_.Word();
      if (key == "kids") break;
      ReadEntry(key, scope);
    }
    const int kids = lines_.Count("kids");
    const Placement placement = {parent.rotation * scope.own.rotation,
                                 parent.rotation * scope.own.translation + parent.translation};
    if (!scope.hidden) Keep(std::move(scope.object), placement);
    for (int i = 0; i < kids && NextChild(i, kids); ++i) ReadObject(placement, depth + 1);
  }

  // TORCS's writer counts too many children; its files end before all have come.
  bool NextChild(int index, int count) {
    if (counts_are_exact_) {
      lines_.Need(fmt::format("OBJECT (child {} of {})", index + 1, count));
    } else if (!lines_.Next()) {
      return false;
    }
    if (lines_.Word() != "OBJECT") lines_.Fail("expected OBJECT (a child)");
    return true;
  }

  void Keep(Ac3dObject object, const Placement& placement) {
    if (object.surfaces.empty()) return;
    for (Eigen::Vector3f& vertex : object.vertices) {
      vertex = ZUp(placement.rotation * vertex + placement.translation);
    }
    for (Eigen::Vector3f& normal : object.normals) {
      normal = ZUp(placement.rotation * normal).stableNormalized();
      if (normal.squaredNorm() < 0.5F) normal = Eigen::Vector3f::UnitZ();
    }
    model_.objects.push_back(std::move(object));
  }

  void ReadEntry(std::string_view key, Scope& scope) {
    if (key == "name") {
      scope.object.name = lines_.Word();
    } else if (key == "texture") {
      ReadTexture(scope);
    } else if (key == "texrep") {
      for (int i = 0; i < 2; ++i) scope.texture_repeat[i] = lines_.Float("texrep");
    } else if (key == "texoff") {
      for (int i = 0; i < 2; ++i) scope.texture_offset[i] = lines_.Float("texoff");
    } else if (key == "crease") {
      scope.object.crease_deg = lines_.Float("crease");
    } else if (key == "loc") {
      scope.own.translation = ReadVector("loc");
    } else if (key == "rot") {
      // Nine numbers that multiply a row vector from the right: its transpose for columns.
      for (int column = 0; column < 3; ++column) scope.own.rotation.col(column) = ReadVector("rot");
    } else if (key == "data") {
      lines_.SkipBytes(static_cast<std::size_t>(lines_.Count("data")));
    } else if (key == "hidden") {
      scope.hidden = true;
    } else if (key == "numvert") {
      ReadVertices(scope.object);
    } else if (key == "numsurf") {
      ReadSurfaces(scope);
    } else if (key.empty() || std::isalpha(static_cast<unsigned char>(key.front())) == 0) {
      lines_.Fail(fmt::format("expected an entry of an object, found '{}'", key));
    }  // else an entry of no interest (url, subdiv, locked, ...)
  }

  // TORCS names the layer after the file: base, tiled (shadow map), skids (tyre marks), shad.
  void ReadTexture(Scope& scope) {
    const std::string_view file = lines_.Word();
    const std::string_view layer = lines_.Word();
    const bool none = file == kNoTexture || file == "(null)" || file.empty();
    if (layer.empty() || layer == "base") {
      scope.object.texture = none ? "" : file;
    } else if (layer == "tiled" && !none) {
      scope.object.shade_texture = file;
    }
  }

  void ReadVertices(Ac3dObject& object) {
    const int count = lines_.Count("numvert");
    for (int i = 0; i < count; ++i) {
      lines_.Need("a vertex");
      object.vertices.push_back(ReadVector("a vertex"));
      if (!lines_.AtEnd()) object.normals.push_back(ReadVector("a normal"));
    }
    if (!object.normals.empty() && object.normals.size() != object.vertices.size()) {
      lines_.Fail("expected a normal with all vertices of the object or with none");
    }
  }

  void ReadSurfaces(Scope& scope) {
    const int count = lines_.Count("numsurf");
    for (int i = 0; i < count; ++i) {
      lines_.Need("SURF");
      if (lines_.Word() != "SURF")
        lines_.Fail(fmt::format("expected SURF ({} of {})", i + 1, count));
      ReadSurface(lines_.Count("SURF"), scope);
    }
  }

  // Flags: low nibble 0 polygon, 1 closed line, 2 line, 4 triangle strip; 0x10 smooth, 0x20 two
  // sides.
  void ReadSurface(int flags, Scope& scope) {
    Ac3dSurface surface;
    surface.is_strip = (flags & 0xF) == 4;
    surface.smooth = (flags & 0x10) != 0;
    surface.two_sided = (flags & 0x20) != 0;
    lines_.Need("mat or refs");
    std::string_view key = lines_.Word();
    if (key == "mat") {
      surface.material = lines_.Count("mat");
      lines_.Need("refs");
      key = lines_.Word();
    }
    if (key != "refs") lines_.Fail(fmt::format("expected refs, found '{}'", key));
    ReadCorners(lines_.Count("refs"), scope, surface);
    const bool is_line = (flags & 0xF) == 1 || (flags & 0xF) == 2;
    if (is_line || surface.corners.size() < 3) return;
    if (static_cast<std::size_t>(surface.material) >=
        std::max<std::size_t>(1, model_.materials.size())) {
      lines_.Fail(fmt::format("material {} of {}", surface.material, model_.materials.size()));
    }
    scope.object.surfaces.push_back(std::move(surface));
  }

  // A vertex, the pair of the base texture, then one pair for each further layer: the shadow map's
  // is the first of them.
  void ReadCorners(int count, const Scope& scope, Ac3dSurface& surface) {
    for (int i = 0; i < count; ++i) {
      lines_.Need("a corner");
      Ac3dCorner corner;
      corner.vertex = lines_.Count("a corner's vertex");
      if (static_cast<std::size_t>(corner.vertex) >= scope.object.vertices.size()) {
        lines_.Fail(fmt::format("vertex {} of {}", corner.vertex, scope.object.vertices.size()));
      }
      for (int k = 0; k < 2; ++k) corner.uv[k] = lines_.Float("a texture coordinate");
      corner.uv = corner.uv.cwiseProduct(scope.texture_repeat) + scope.texture_offset;
      corner.shade_uv.setZero();
      if (!scope.object.shade_texture.empty()) {
        for (int k = 0; k < 2; ++k) corner.shade_uv[k] = lines_.Float("a shadow map's coordinate");
      }
      surface.corners.push_back(corner);
    }
  }

  Ac3dLines lines_;
  bool counts_are_exact_;
  Ac3dModel model_;
};

}  // namespace

Ac3dModel ParseAc3d(std::string_view text, const std::filesystem::path& path) {
  return Ac3dParser(text, path).Parse();
}

Ac3dModel ReadAc3d(const std::filesystem::path& path) {
  const std::string text = ReadText(path);
  return ParseAc3d(text, path);
}

}  // namespace lift_slam

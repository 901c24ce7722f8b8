#include "lift_slam/testing/textured_world.h"

#include "lift_slam/testing/camera_path.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using Eigen::Vector3d;

// Textures of a world by their index.
constexpr int kGround = 0, kFirstWall = 1, kNumWalls = 3;

class WorldBuilder {
 public:
  WorldBuilder(TextureKind walls, std::uint64_t seed) : random_(seed) {
    world_.textures.push_back(MakeTexture(TextureKind::kGround, random_.Bits()));
    for (int i = 0; i < kNumWalls; ++i) {
      world_.textures.push_back(MakeTexture(walls, random_.Bits()));
    }
    world_.textures.push_back(MakeTexture(TextureKind::kClutter, random_.Bits()));
  }

  Random& random() { return random_; }
  int RandomWall() { return random_.UniformInt(kFirstWall, kFirstWall + kNumWalls - 1); }
  int Clutter() const { return kFirstWall + kNumWalls; }
  TexturedWorld Take() { return std::move(world_); }

  void AddQuad(const Vector3d& corner, const Vector3d& edge_u, const Vector3d& edge_v, int texture,
               double texels_per_metre, double brightness) {
    TexturedQuad quad{corner, edge_u, edge_v, texture, texels_per_metre};
    quad.offset_texels = {random_.Uniform(0.0, 1024.0), random_.Uniform(0.0, 1024.0)};
    quad.brightness = brightness;
    world_.quads.push_back(quad);
  }

  // A box that stands with its base at the height of world_from_box's origin: 2 half_width wide
  // (x), `height` up (-y), 2 half_depth deep (z). No bottom.
  void AddBox(const Rigid3d& world_from_box, double half_width, double height, double half_depth,
              int texture, double texels_per_metre) {
    const auto at = [&](double x, double y, double z) {
      return Vector3d(world_from_box * Vector3d(x, y, z));
    };
    const double w = half_width, d = half_depth;
    const Vector3d x = at(2 * w, 0, 0) - at(0, 0, 0), z = at(0, 0, 2 * d) - at(0, 0, 0);
    const Vector3d down = at(0, height, 0) - at(0, 0, 0);
    AddQuad(at(-w, -height, -d), x, down, texture, texels_per_metre, 1.0);   // towards -z
    AddQuad(at(-w, -height, d), x, down, texture, texels_per_metre, 0.9);    // towards +z
    AddQuad(at(-w, -height, -d), z, down, texture, texels_per_metre, 0.75);  // towards -x
    AddQuad(at(w, -height, -d), z, down, texture, texels_per_metre, 0.8);    // towards +x
    AddQuad(at(-w, -height, -d), x, z, texture, texels_per_metre, 1.1);      // top
  }

 private:
  Random random_;
  TexturedWorld world_;
};

Rigid3d Standing(double x, double y, double z, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitY())), {x, y, z}};
}

void AddHouse(WorldBuilder& builder, double distance, double side, double width) {
  Random& random = builder.random();
  const double setback = random.Uniform(7.0, 9.5), height = random.Uniform(6.0, 13.0);
  const Rigid3d place = WorldFromStreet(distance) * Rigid3d(Eigen::Quaterniond::Identity(),
                                                            {side * (setback + 5.0), 1.65, 0.0});
  builder.AddBox(place, 5.0, height, 0.5 * width, builder.RandomWall(), 45.0);
}

void AddParkedCar(WorldBuilder& builder, double distance, double side) {
  Random& random = builder.random();
  const double offset = random.Uniform(3.8, 4.6), turn = random.Uniform(-0.05, 0.05);
  const Rigid3d place = WorldFromStreet(distance) *
                        Rigid3d(Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitY())),
                                {side * offset, 1.65, 0.0});
  builder.AddBox(place, 0.85, random.Uniform(1.4, 2.0), 2.1, builder.Clutter(), 90.0);
}

void AddPole(WorldBuilder& builder, double distance, double side) {
  const Rigid3d place =
      WorldFromStreet(distance) * Rigid3d(Eigen::Quaterniond::Identity(), {side * 5.6, 1.65, 0.0});
  builder.AddBox(place, 0.12, builder.random().Uniform(3.0, 6.0), 0.12, builder.Clutter(), 120.0);
}

void AddLaneMark(WorldBuilder& builder, double distance) {
  const Rigid3d place = WorldFromStreet(distance);
  const Vector3d corner = place * Vector3d(1.6, 1.645, -1.5);
  builder.AddQuad(corner, place.rotation * Vector3d(0.15, 0, 0), place.rotation * Vector3d(0, 0, 3),
                  kGround, 60.0, 1.7);
}

}  // namespace

TexturedWorld MakeRoom(std::uint64_t seed) {
  WorldBuilder builder(TextureKind::kClutter, seed);
  constexpr double kX = 4.0, kY = 1.5, kZ = 3.0, kTexels = 90.0;
  const Vector3d x(2 * kX, 0, 0), y(0, 2 * kY, 0), z(0, 0, 2 * kZ);
  builder.AddQuad({-kX, -kY, -kZ}, x, y, kFirstWall, kTexels, 0.95);
  builder.AddQuad({-kX, -kY, kZ}, x, y, kFirstWall + 1, kTexels, 1.0);
  builder.AddQuad({-kX, -kY, -kZ}, z, y, kFirstWall + 2, kTexels, 0.85);
  builder.AddQuad({kX, -kY, -kZ}, z, y, builder.Clutter(), kTexels, 0.9);
  builder.AddQuad({-kX, kY, -kZ}, x, z, kGround, kTexels, 0.9);
  builder.AddQuad({-kX, -kY, -kZ}, x, z, kGround, kTexels, 1.2);
  builder.AddBox(Standing(0.0, kY, 0.3, 0.4), 0.7, 0.8, 0.4, builder.RandomWall(), 150.0);
  builder.AddBox(Standing(-1.8, kY, 2.4, 0.1), 0.5, 1.9, 0.3, builder.RandomWall(), 150.0);
  builder.AddBox(Standing(1.6, kY, 2.5, -0.1), 0.8, 1.2, 0.4, builder.RandomWall(), 150.0);
  builder.AddBox(Standing(3.5, kY, 0.3, 0.0), 0.3, 1.6, 0.7, builder.RandomWall(), 150.0);
  builder.AddBox(Standing(-3.5, kY, -0.5, 0.0), 0.3, 1.1, 0.9, builder.RandomWall(), 150.0);
  builder.AddBox(Standing(0.8, kY, -2.6, 0.05), 0.9, 1.0, 0.25, builder.RandomWall(), 150.0);
  return builder.Take();
}

TexturedWorld MakeStreet(std::uint64_t seed) {
  WorldBuilder builder(TextureKind::kFacade, seed);
  Random& random = builder.random();
  builder.AddQuad({-600, 1.65, -200}, {1200, 0, 0}, {0, 0, 1200}, kGround, 60.0, 0.75);
  for (const double side : {-1.0, 1.0}) {
    double distance = -5.0;
    while (distance < kStreetLength) {
      const double width = random.Uniform(8.0, 15.0);
      AddHouse(builder, distance + 0.5 * width, side, width);
      distance += width + (random.Uniform() < 0.3 ? random.Uniform(2.0, 6.0) : 0.0);
    }
    for (double place = 6.0; place < kStreetLength; place += random.Uniform(6.0, 16.0)) {
      AddParkedCar(builder, place, side);
      AddPole(builder, place + 3.2, side);
    }
  }
  for (double place = 2.0; place < kStreetLength; place += 6.0) AddLaneMark(builder, place);
  return builder.Take();
}

}  // namespace lift_slam

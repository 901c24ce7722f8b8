#include "lift_slam/simulation/rendering/pinhole_view.h"

namespace lift_slam {
namespace {

// A sample's centre is half a sample inside its border: x_ndc = 2 (x_sample + 0.5) / width - 1.
Eigen::Matrix3d NdcFromView(const PinholeIntrinsics& p) {
  Eigen::Matrix3d ndc_from_view = Eigen::Matrix3d::Identity();
  ndc_from_view(0, 0) = 2.0 * p.fx / p.width;
  ndc_from_view(0, 2) = 2.0 * (p.cx + 0.5) / p.width - 1.0;
  ndc_from_view(1, 1) = 2.0 * p.fy / p.height;
  ndc_from_view(1, 2) = 2.0 * (p.cy + 0.5) / p.height - 1.0;
  return ndc_from_view;
}

}  // namespace

Eigen::Matrix4d ClipFromEye(const PinholeView& view, const Eigen::Matrix3d& cam_from_scene,
                            const DepthRange& range) {
  const Eigen::Matrix3d view_from_scene = view.view_from_cam * cam_from_scene;
  const Eigen::Matrix3d ndc_from_scene = NdcFromView(view.pinhole) * view_from_scene;
  const double scale = range.near_m / (range.far_m - range.near_m);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip.row(0).head<3>() = ndc_from_scene.row(0);
  clip.row(1).head<3>() = ndc_from_scene.row(1);
  clip.row(2) << -scale * view_from_scene.row(2), scale * range.far_m;
  clip.row(3).head<3>() = view_from_scene.row(2);
  return clip;
}

Eigen::Matrix3d SceneFromNdc(const PinholeView& view, const Eigen::Matrix3d& cam_from_scene) {
  return (view.view_from_cam * cam_from_scene).transpose() * NdcFromView(view.pinhole).inverse();
}

}  // namespace lift_slam

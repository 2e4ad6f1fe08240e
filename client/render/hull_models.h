#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "client/render/render_frame.h"
#include "common/base/vec.h"

/// Looks of bodies, made by code. Body frame: x forward, y left, z up [m]. Sizes > 0.
namespace onesea::render {

using SharedHullMesh = std::shared_ptr<const HullMesh>;

/// A motor boat with bulwark, wheelhouse and outboard motor: vee bottom, raked stem, flat transom.
/// The keel's lowest line is at z = 0, the deck at z = depth_m, midships at x = 0. Topsides take
/// the instance's colour.
SharedHullMesh BoatModel(double length_m = 5.0, double beam_m = 2.0, double depth_m = 0.9);

/// A float with a tower, a band and a lantern; the float is a cylinder centred at the origin. The
/// colour is the instance's.
SharedHullMesh BuoyModel(double radius_m = 0.6, double height_m = 0.9);

/// A wooden crate with frames, centred at the origin.
SharedHullMesh CrateModel(Vec3d size_m = {1, 1, 1});

/// A drum with two hoops, axis along z, centred at the origin; the colour is the instance's.
SharedHullMesh BarrelModel(double radius_m = 0.3, double height_m = 0.9);

/// A fender: a ball with two bands; the colour is the instance's.
SharedHullMesh BallModel(double radius_m = 0.5);

/// A float with round ends and two bands, axis along x, centred at the origin; `length_m` is
/// without the ends. The colour is the instance's.
SharedHullMesh CapsuleModel(double radius_m = 0.4, double length_m = 1.6);

/// Planks lashed over logs that lie along x; bounds centred at the origin.
SharedHullMesh RaftModel(Vec3d size_m = {4, 3, 0.5});

/// Any triangle mesh in grey paint that takes the instance's colour; corners counter-clockwise seen
/// from outside. Pre: indices below vertices.size().
SharedHullMesh PlainModel(std::span<const Vec3d> vertices_m,
                          std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace onesea::render

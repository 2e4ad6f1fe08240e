#pragma once

#include "server/world/hull.h"
#include "server/world/rigid_math.h"

/// What flow that leaves a hull at a cut-off stern does to it.
namespace onesea::world {

/// The after end of a hull.
struct Stern {
  double x_m = 0.0;    ///< from the centre of mass, body axes; negative
  double share = 0.0;  ///< section there over the mean section; 0: pointed or round
};

/// Faces that look astern at the last twentieth of the length are the stern.
Stern SternOf(const TriangleMesh& mesh, const SolidProperties& solid, Vec3d centre_of_mass_m);

/// Linear damping, to be added to the others while the hull moves ahead through the water.
///
/// Added mass alone gives a body at an angle to its course a moment that turns it farther
/// (Munk's): right for a spindle, behind which the flow closes. Where it breaks off at a stern the
/// water keeps the momentum that the last section gave it:
///   F = -a_T U v_T at the stern,  v_T its velocity athwart or upwards, a_T = share A / length
/// with A the added mass of the whole hull in sway or heave. That is the lift of a planing bottom
/// and of a skeg: it takes energy, and keeps the hull on its course and its trim.
/// Zero for U <= 0. Symmetric, never negative.
/// Source: R. T. Jones, "Properties of low-aspect-ratio pointed wings at speeds below and above the
///   speed of sound", NACA report 835, 1946: slender bodies with a trailing edge.
Mat6 SternDamping(const Stern& stern, double length_m, const Mat6& added_mass,
                  double ahead_m_per_s);

}  // namespace onesea::world

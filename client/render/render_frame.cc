#include "client/render/render_frame.h"

namespace onesea::render {

CascadePlanes PlanesOf(const sea::CascadeFields& fields, const sea::Cascade& cascade) {
  using sea::Field;
  return {fields.grid_size(),
          cascade.length_m,
          cascade.rotation_rad,
          fields.Plane(Field::kHeight),
          fields.Plane(Field::kDisplacementX),
          fields.Plane(Field::kDisplacementY),
          fields.Plane(Field::kSlopeX),
          fields.Plane(Field::kSlopeY),
          fields.Plane(Field::kJacobianXX),
          fields.Plane(Field::kJacobianYY)};
}

}  // namespace onesea::render

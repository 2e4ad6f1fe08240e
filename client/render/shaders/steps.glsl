// Steps in distance between neighbouring pixels of a picture with one sample each: where crests stand
// before farther water or the sky. `depth_map` is logarithmic in distance (surface_grid.vert.glsl):
// a difference is a ratio of distances, and the sky is 1.
uniform sampler2D depth_map;

const float kStep = 0.0028;  // four per cent

// To the next pixel upwards, or nearly so: crests are crossed this way, whatever the camera's roll.
ivec2 upwards() { return abs(ray_up.z) * ray_right.w >= abs(ray_right.z) * ray_up.w ? ivec2(0, 1) : ivec2(1, 0); }

ivec2 inside(ivec2 pixel) { return clamp(pixel, ivec2(0), ivec2(ray_right.w, ray_up.w) - 1); }

float depth_at(ivec2 pixel) { return texelFetch(depth_map, inside(pixel), 0).r; }

// The uniform block that every pass shares; client/render/frame_block.h says what each word means.
layout(std140) uniform Frame {
  mat4 clip_from_world;
  vec4 ray_forward;
  vec4 ray_right;
  vec4 ray_up;
  vec4 eye;
  vec4 sun_direction;
  vec4 sun_irradiance;
  vec4 sky_irradiance;
  vec4 water_leaving;
  vec4 crest_radiance;
  vec4 foam_irradiance;
  vec4 haze;
  vec4 cloud_radiance;
  vec4 wind;
  vec4 foam_window;
  vec4 foam_level;
  vec4 foam_detail;
  vec4 ripple_map;
  vec4 ripple_stats;
  vec4 fine_variance;
  vec4 grid;
  vec4 grid_rows;
  vec4 counts;
  vec4 cascade_map[8];
  vec4 cascade_turn[8];
  vec4 cascade_share[8];
  vec4 regular[32];
  vec4 patch_map[6];
  vec4 patch_cell[6];
  vec4 ground_place;
  vec4 ground_area;
  vec4 ground_noise;
  vec4 attenuation_place;
  vec4 water_kd;
  vec4 bottom_irradiance;
};

const float kPi = 3.14159265;
const float kEarthRadius = 6371000.0;

// The ray through a point of the picture; `at` in [-1, 1].
vec3 picture_ray(vec2 at) {
  return normalize(ray_forward.xyz + at.x * ray_right.xyz + at.y * ray_up.xyz);
}

// Where the undisplaced point `xy` (relative to the eye) lies in cascade `c`, in turns.
vec2 tile_coordinate(int c, vec2 xy) {
  vec2 turn = cascade_turn[c].xy;
  vec2 local = vec2(turn.x * xy.x + turn.y * xy.y, turn.x * xy.y - turn.y * xy.x);
  return local * cascade_map[c].z + cascade_map[c].xy;
}

// Where the point `xy` of the water (relative to the eye) lies in patch `n` of the interaction layer.
vec3 patch_coordinate(int n, vec2 xy) {
  return vec3(xy * patch_map[n].zw + patch_map[n].xy, patch_cell[n].y);
}

// `moved` and what the regular waves, times `factor`, add to it at the undisplaced point `xy`.
vec3 with_regular_waves(vec3 moved, vec2 xy, float factor) {
  int regulars = int(counts.y);
  for (int n = 0; n < regulars; ++n) {
    vec4 wave = regular[n];
    float phase = dot(wave.xy, xy) + wave.w;
    moved += vec3(-water_leaving.w * normalize(wave.xy) * sin(phase), cos(phase)) * (wave.z * factor);
  }
  return moved;
}

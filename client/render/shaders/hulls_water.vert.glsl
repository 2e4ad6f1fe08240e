// The water under each hull, once a picture: one point per hull into a row of texels.
uniform sampler2DArray displacement_map;
uniform sampler2DArray patch_height_map;
layout(location = 0) in vec4 place;  // xy relative to the eye; reach [m]; texel
flat out vec4 plane;

// Waves shorter than the hull average out over it.
float water_height(vec2 xy, float lod_m) {
  vec2 moved = vec2(0.0);
  float height = 0.0;
  int cascades = int(counts.x);
  for (int step = 0; step < 2; ++step) {
    vec2 from = xy - moved;
    vec3 sum = vec3(0.0);
    vec4 factors = wave_factors(from, 0);
    for (int c = 0; c < cascades; ++c) {
      float lod = max(lod_m - cascade_map[c].w, 0.0);
      if (c == 4) factors = wave_factors(from, 1);
      sum += factors[c & 3] * textureLod(displacement_map, vec3(tile_coordinate(c, from), float(c)), lod).xyz;
    }
    sum = with_regular_waves(sum, from, wave_factors(from, cascades / 4)[cascades & 3]);
    moved = sum.xy;
    height = sum.z;
  }
  int patches = int(counts.w);
  for (int n = 0; n < patches; ++n) height += textureLod(patch_height_map, patch_coordinate(n, xy), 0.0).r;
  return height;
}

void main() {
  vec2 xy = place.xy;
  float reach = place.z, fineness = log2(reach);
  float east = water_height(xy + vec2(reach, 0.0), fineness), west = water_height(xy - vec2(reach, 0.0), fineness);
  float north = water_height(xy + vec2(0.0, reach), fineness), south = water_height(xy - vec2(0.0, reach), fineness);
  plane = vec4(0.25 * (east + west + north + south), (east - west) / (2.0 * reach), (north - south) / (2.0 * reach), 1.0);
  gl_Position = vec4((2.0 * place.w + 1.0) / float(kHulls) - 1.0, 0.0, 0.0, 1.0);
}

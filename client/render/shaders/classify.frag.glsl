// Sorts pixels by how they must be shaded, as depth, so that later passes skip whole blocks of them
// before any shader runs. Classes: see client/render/passes/classify.h.
#if SAMPLES > 1
uniform sampler2DMS surface_map;
#elif TERRAIN
uniform sampler2D surface_map;
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
#if SAMPLES > 1
  float low = 1e9, high = -1e9, covered = 0.0, land = 0.0;
  for (int n = 0; n < SAMPLES; ++n) {
    vec4 s = texelFetch(surface_map, pixel, n);
    covered += s.w > 0.5 ? 1.0 : 0.0;
    land += s.w < -0.5 ? 1.0 : 0.0;
    low = min(low, s.z);
    high = max(high, s.z);
  }
  bool sheet = covered == float(SAMPLES) && high - low < 0.04 * abs(high) + 0.05;
  bool sky = covered + land == 0.0 && eye.z >= 0.0;
  bool ground = land == float(SAMPLES);
  gl_FragDepth = sheet ? 0.0 : (sky ? 0.5 : (ground ? 0.625 : 1.0));
#else
  float self = depth_at(pixel);
  ivec2 up = upwards();
  // The second difference: the sea's way to the horizon is steep but even.
  bool step = abs(depth_at(pixel + up) + depth_at(pixel - up) - 2.0 * self) > kStep;
  // Under water there is no sky: rays that meet no surface end in the water.
  bool sky = self == 1.0 && eye.z >= 0.0;
  float sheet = 0.0;
#if TERRAIN
  sheet = texelFetch(surface_map, pixel, 0).w < -0.5 ? 0.875 : 0.0;
#endif
  gl_FragDepth = step ? 0.5 : (sky ? 1.0 : sheet);
#endif
}

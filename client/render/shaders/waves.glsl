// The waves within a pixel.
//
// Slopes come from the undisplaced point, filtered to the pixel's footprint; the variance that
// the filter removed, plus that of waves which no texture holds, is the pixel's roughness.
uniform sampler2DArray slope_map;
uniform sampler2D ripple_slope_map;
uniform sampler2DArray patch_slope_map;

struct Waves {
  vec2 slope;      // mean over the footprint, with respect to the undisplaced point
  float squeeze;   // trace of J: mean over the footprint
  vec3 variance;   // xx, yy, xy: of the slopes within the footprint
  float folding;   // variance of J within the footprint, of the cascades alone
  float churned;   // share that wakes and splashes have made white
#if ATTENUATED
  float steep;     // what shallow water and land leave of the slope variance
  float hs;        // and of the height, four deviations [m]
#endif
};

vec3 normal_of(Waves w) {
  return normalize(vec3(-w.slope, max(1.0 + w.squeeze, 0.12)));
}

// Straight code on purpose: software rasterisers run both sides of every branch, and a loop that
// might end early costs them more than what it skips. CASCADES is a constant for the same reason.
// `xy` is the undisplaced point, `place` where it is now.
Waves gather(vec2 xy, vec2 place, float distance, float stretch) {
#if ATTENUATED
  Waves w = Waves(vec2(0.0), 0.0, vec3(0.0), 0.0, 0.0, 0.0, 0.0);
  vec4 factors = wave_factors(xy, 0);
#else
  Waves w = Waves(vec2(0.0), 0.0, vec3(0.0), 0.0, 0.0);
#endif
  // Footprint: the pixel, longer along the view than across, filtered by one round kernel between
  // the two. Beyond some stretch only the faces that look at the eye are seen, and they are not long.
  stretch = min(stretch, 14.0);
  float footprint = log2(distance * ray_forward.w) + 0.75 * log2(stretch);
  float lost_sum = 0.0;
  for (int c = 0; c < CASCADES; ++c) {
    float lod = max(footprint - cascade_map[c].w - 0.3, 0.0);
    vec3 at = vec3(tile_coordinate(c, xy), float(c));
    vec4 slope = textureLod(slope_map, at, lod);
#if ATTENUATED
    if (c == 4) factors = wave_factors(xy, 1);
    float factor = factors[c & 3];
    w.steep += factor * factor * cascade_share[c].w;
    w.hs += factor * factor * cascade_turn[c].z;
    slope *= vec4(vec3(factor), factor * factor);
#endif
    w.slope += slope.xy;
    w.squeeze += slope.z;
    float lost = max(slope.w - dot(slope.xy, slope.xy), 0.0);
    lost_sum += lost;
    w.variance += lost * cascade_share[c].xyz;
  }
  // A wave of slope s changes J by choppiness times s.
  w.folding = water_leaving.w * water_leaving.w * lost_sum;
  w.variance += fine_variance.xyz;
#if RIPPLES
  float ripple_lod = max(footprint + 0.15 * log2(stretch) - ripple_map.w, 0.0);
  vec2 at = xy * ripple_map.z + ripple_map.xy;
  w.slope += 0.8 * textureLod(ripple_slope_map, at, ripple_lod).xy;
  // The same tile again, finer and turned: waves of 2.5 cm, and no repetition after 3.7 m.
  const mat2 kTurn = mat2(0.77, 0.64, -0.64, 0.77);
  vec2 fine = textureLod(ripple_slope_map, kTurn * at * 3.3, ripple_lod + 1.72).xy;
  w.slope += 0.6 * (fine * kTurn);
  // The share of their variance that a mip has lost, measured once: s-shaped in its level.
  float lost = 0.64 * smoothstep(-0.5, 4.2, ripple_lod) + 0.36 * smoothstep(-2.2, 2.5, ripple_lod);
  w.variance += ripple_stats.xyz * lost;
#endif
#if REGULARS
  int regulars = int(counts.y);
#if ATTENUATED
  float regular_factor = wave_factors(xy, CASCADES / 4)[CASCADES & 3];
#endif
  for (int n = 0; n < regulars; ++n) {
    vec4 wave = regular[n];
#if ATTENUATED
    wave.z *= regular_factor;
    w.hs += 0.5 * wave.z * wave.z;
#endif
    float phase = dot(wave.xy, xy) + wave.w;
    w.slope -= wave.xy * wave.z * sin(phase);
    w.squeeze -= water_leaving.w * wave.z * length(wave.xy) * cos(phase);
  }
#endif
#if PATCHES
  // Slopes at a place, not at an undisplaced point: normal_of() divides by 1 + squeeze.
  float stretched = max(1.0 + w.squeeze, 0.12);
  for (int n = 0; n < PATCHES; ++n) {
    float lod = max(footprint - patch_cell[n].x - 0.3, 0.0);
    vec4 slope = textureLod(patch_slope_map, patch_coordinate(n, place), lod);
    w.slope += slope.xy * stretched;
    w.variance.xy += 0.5 * max(slope.w - dot(slope.xy, slope.xy), 0.0);
    w.churned += slope.z;
  }
#endif
#if ATTENUATED
  w.hs = 4.0 * sqrt(w.hs);
#endif
  return w;
}

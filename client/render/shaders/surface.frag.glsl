// Light from the sea towards the eye, for every pixel that the lattice covered. Needs waves.glsl,
// with TERRAIN shore.glsl, and what these need.
uniform sampler2D foam_window_map;
uniform sampler2D foam_map;
#if HULLS
uniform sampler2D mirror_map;  // hulls upside down, as flat water would show them; premultiplied
uniform sampler2D mirror_distance_map;  // of that water, premultiplied
#endif
#if SAMPLES > 1
uniform sampler2DMS surface_map;
#else
uniform sampler2D surface_map;
#endif
in vec2 picture;
out vec4 radiance;

vec3 sun_glitter(Facets f, vec2 mean, vec3 variance, vec3 v) {
  vec3 h = normalize(v + sun_direction.xyz);
  if (sun_direction.z < -0.02 || h.z <= 0.02) return vec3(0.0);
  vec2 off = -h.xy / h.z - mean;
  // The sun's own disc widens every facet's glint.
  vec3 s = variance + vec3(6e-6, 6e-6, 0.0);
  float determinant = max(s.x * s.y - s.z * s.z, 1e-9);
  float exponent = (s.y * off.x * off.x - 2.0 * s.z * off.x * off.y + s.x * off.y * off.y) / determinant;
  float density = exp(-0.5 * min(exponent, 60.0)) / (2.0 * kPi * sqrt(determinant));
  float h2 = h.z * h.z;
  // High suns' glints are seen white: the film has lost their hue before it sees them.
  float grey = dot(sun_irradiance.rgb, vec3(0.2126, 0.7152, 0.0722));
  vec3 sun = mix(sun_irradiance.rgb, vec3(grey), smoothstep(0.1, 0.6, sun_direction.z));
  return sun * (fresnel_exact(max(dot(h, v), 0.0)) * density / (4.0 * f.area * h2 * h2));
}

// Mean 1. Where a pixel sees only a few facets that can glint, their number is a matter of chance:
// numbers of mean 1, mostly small, in cells of about a pixel, drawn anew eight times a second.
float sparkle(vec2 xy, float footprint) {
  // The next power of two.
  float size = uintBitsToFloat((floatBitsToUint(max(footprint, 0.004)) + 0x7fffffu) & 0xff800000u);
  vec2 cell = floor(xy / size + foam_detail.xy * (1.0 / foam_detail.z) / size);
  float turn = floor(eye.w * 8.0 + fract(dot(cell, vec2(0.371, 0.729))));
  vec3 p = fract(vec3(cell, turn) * vec3(0.1031, 0.1030, 0.0973));
  p += dot(p, p.yzx + 33.33);
  float u = fract((p.x + p.y) * p.z);
  float chance = 0.75 * (1.0 - smoothstep(0.15, 2.0, footprint));
  // Mean, variance and darkest tenth of an exponential number, without its logarithm.
  float u2 = u * u;
  return mix(1.0, u * (1.2 + 3.2 * u2 * u2 * u2), chance);
}

struct Foam {
  float mask;      // white
  float bubbles;   // turquoise below
  float shade;     // of its own relief
};

Foam foam_at(vec2 xy, Waves w, float fold, float footprint_log2) {
  float spread = sqrt(max(w.folding, 1e-6));
  // Even a resolved fold foams by degrees: thin lace first, froth where it is deepest.
  float cover = 0.85 * share_below(wind.w, fold, max(spread, 0.05));
  vec2 edge = abs(xy) / max(foam_window.w, 1e-3);
  float inside = 1.0 - smoothstep(0.75, 0.97, max(edge.x, edge.y));
  vec2 at = xy * foam_detail.z + foam_detail.xy;
  float detail_lod = max(footprint_log2 + foam_detail.w, 0.0);
  float lace = textureLod(foam_map, at, detail_lod).r;
  float fine = textureLod(foam_map, mat2(0.8, 0.6, -0.6, 0.8) * at * 2.7, detail_lod + 1.43).r;
  // Far away the tile's own lace is too small to see, and one five times as large takes over.
  float coarse = textureLod(foam_map, mat2(0.6, 0.8, -0.8, 0.6) * at * 0.21, max(detail_lod - 1.75, 0.0)).r;

  // Never the finest level: patches thin out over some metres, not from cell to cell.
  float window_lod = max(footprint_log2 + foam_level.z, 1.0);
  // Bent by the lace, so that the window's cells don't show.
  vec2 bent = xy + vec2(coarse - 0.5, lace - 0.5) * 1.6;
  float window = textureLod(foam_window_map, bent * foam_window.z + foam_window.xy, window_lod).r;
  float fresh = clamp((window - foam_level.x) * foam_level.y, 0.0, 1.0);
#if ATTENUATED
  // The window knows the open sea's foam only.
  float broken = min(w.steep, 1.0);
  fresh *= broken;
  window *= broken;
#endif
  // The old foam around it is lace with more holes than film.
  cover = mix(cover, max(0.80 * fresh, 0.26 * window), inside);
#if PATCHES || TERRAIN
  cover = max(cover, 0.9 * min(w.churned, 1.0));
#endif

  float nearness = clamp(1.6 - 0.4 * detail_lod, 0.0, 1.0);
  lace = 0.5 + nearness * (0.62 * (lace - 0.5) + 0.42 * (fine - 0.5)) + mix(1.0, 0.35, nearness) * (coarse - 0.5);
  lace = clamp(lace, 0.0, 1.0);
  float width = clamp(0.8 * cover, 0.02, 0.36);
  float mask = smoothstep(1.0 - cover - width, 1.0 - cover + width, lace) * smoothstep(0.0, 0.03, cover);
  float froth = 1.0 - clamp(detail_lod * 0.25 - 1.0, 0.0, 1.0);
  // Thick froth hides the water, thin film lets it through.
  mask = mix(cover, mask * (0.36 + 0.64 * lace), froth);
  return Foam(mask, clamp(cover * 0.8, 0.0, 1.0), mix(1.0, 0.72 + 0.5 * fine, froth));
}

#if HULLS
// What stands in the water's mirror for a facet of the given slope, `reach` metres from it. Waves
// before or behind the water under the hull don't show it.
vec4 mirrored(vec3 from, vec3 direction, float distance, vec2 slope, float reach) {
  vec3 r = reflect(direction, normalize(vec3(-slope, 1.0)));
  vec4 clip = clip_from_world * vec4(from + reach * vec3(r.xy, -abs(r.z)), 1.0);
  vec2 at = 0.5 + 0.5 * clip.xy / max(clip.w, 0.1);
  vec4 image = textureLod(mirror_map, at, 0.0);
  float there = textureLod(mirror_distance_map, at, 0.0).r / max(image.a, 0.01);
  return image * (1.0 - smoothstep(0.2, 0.4, abs(there / distance - 1.0)));
}
#endif

vec3 shade_above(vec2 xy, vec2 place, float distance, float stretch, vec3 direction) {
  vec3 v = -direction;
  Waves w = gather(xy, place, distance, stretch);
  vec3 n = normal_of(w);
  vec2 mean = -n.xy / n.z;
  Facets f = visible_facets(mean, w.variance, v);
  vec3 seen = normalize(vec3(-f.slope, 1.0));

  // Reflection: from the mean visible facet, blurred by the spread of facets.
  float cosine = clamp(dot(n, v), 0.0, 1.0);
  float fresnel = fresnel_mean(cosine, f.deviation);
  vec3 r = reflect(direction, seen);
  float open = smoothstep(-0.25, 0.12, r.z);
  r.z = abs(r.z) + 0.01;
  vec3 reflected = sky_at(normalize(r), 0.7 * f.deviation) * mix(0.45, 1.0, open);

#if TERRAIN
  float height = eye.z + direction.z * distance;
  reflected = with_land(reflected, place, height, normalize(r), f.deviation);
#endif
#if HULLS
  // Three facets of the many in a pixel.
  vec3 from = eye.xyz + direction * distance;
  float reach = clamp(0.05 * distance, 0.5, 3.0);
  vec2 tilt = normalize(direction.xy + 1e-5) * (0.9 * f.deviation);
  vec4 image = (mirrored(from, direction, distance, f.slope, reach) +
                mirrored(from, direction, distance, f.slope + tilt, reach) +
                mirrored(from, direction, distance, f.slope - tilt, reach)) * (1.0 / 3.0);
  reflected = reflected * (1.0 - image.a) + image.rgb;
#endif

  // Light out of the water; crests that the sun shines through.
  vec3 body = water_leaving.rgb;
  float fold = 1.0 + w.squeeze;
  float pinch = clamp(1.0 - fold, 0.0, 1.0);
  float back = max(dot(sun_direction.xyz, direction), 0.0);
  back *= back;
  back *= back;
  float face = 0.5 - 0.5 * dot(sun_direction.xyz, n);
  float glow = pinch * (3.0 * back * face * face + 0.25 * max(0.0, dot(n.xy, v.xy)));
  body += crest_radiance.rgb * glow;

  float footprint = distance * ray_forward.w * sqrt(min(stretch, 14.0));
#if TERRAIN
  Shallow shallow = shallow_at(place, distance, direction, n, log2(footprint));
  body = mix(body, shallow.bottom, shallow.shown);
  w.churned += surf_at(shallow.depth, w);
#endif
  Foam foam = foam_at(xy, w, fold, log2(footprint));
  body += foam_irradiance.rgb * foam.bubbles;

  float wet = 1.0 - foam.mask;
  vec3 glint = min(sun_glitter(f, mean, w.variance, v), vec3(60.0)) * sparkle(xy, footprint);
  vec3 colour = fresnel * reflected + (1.0 - fresnel) * body + glint * wet;
  vec3 light = sun_irradiance.rgb * max(dot(n, sun_direction.xyz), 0.0) + sky_irradiance.rgb * (0.5 + 0.5 * n.z);
  vec3 white = light * (0.55 / kPi) * foam.shade;
  colour = mix(colour, white, foam.mask * 0.92);
#if TERRAIN
  // Where the water ends it is a film on the ground, within a pixel or a hand's breadth.
  float soft = max(0.04, 0.7 * shallow.slope * distance * ray_forward.w);
  colour = mix(ground_light(shallow.ground, direction), colour, smoothstep(0.0, soft, shallow.depth));
#endif
  return through_air(colour, direction, distance);
}

#if UNDERSIDE
// Through the surface from below: Snell's window, and outside it the water mirrored.
vec3 shade_below(vec2 xy, vec2 place, float distance, float stretch, vec3 direction) {
  Waves w = gather(xy, place, distance, stretch);
  vec3 n = normal_of(w);
  float cosine = clamp(dot(n, direction), 0.0, 1.0);
  float sine2 = 1.34 * 1.34 * (1.0 - cosine * cosine);
  vec3 below = 3.0 * water_leaving.rgb;
  vec3 colour = below;
  if (sine2 < 1.0) {
    float out_cosine = sqrt(1.0 - sine2);
    vec3 out_direction = 1.34 * direction + (out_cosine - 1.34 * cosine) * n;
    float fresnel = fresnel_exact(out_cosine);
    colour = mix(sky_at(normalize(out_direction), 0.1) * 1.8, below, fresnel);
  }
  return mix(below, colour, water_passed(distance));
}
#endif

// `s` as surface_grid.frag.glsl writes it.
vec3 shade(vec4 s, vec3 direction) {
  vec2 place = direction.xy * min(abs(s.z), 1e5);
  s.xy = place - s.xy;
#if UNDERSIDE
  s.z = (s.z < 0.0 ? -1.0 : 1.0) * clamp(abs(s.z), 0.01, 1e5);  // pixels without water, too
  s.w = max(s.w, 1.0);
  vec3 above = shade_above(s.xy, place, abs(s.z), s.w, direction);
  vec3 below = shade_below(s.xy, place, abs(s.z), s.w, direction);
  return s.z >= 0.0 ? above : below;
#else
  return shade_above(s.xy, place, s.z, s.w, direction);
#endif
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 direction = picture_ray(picture);
#if EDGES
  // The nearest and the farthest sheet of water in the pixel speak for the samples closer to them.
  vec4 s[SAMPLES];
  vec4 near = vec4(0.0, 0.0, 1e9, 0.0), far = vec4(0.0);
  for (int n = 0; n < SAMPLES; ++n) {
    s[n] = texelFetch(surface_map, pixel, n);
    if (s[n].w > 0.5 && abs(s[n].z) < abs(near.z)) near = s[n];
    if (s[n].w > 0.5 && abs(s[n].z) > abs(far.z)) far = s[n];
  }
  float covered = 0.0, near_share = 0.0, land = 0.0;
  for (int n = 0; n < SAMPLES; ++n) {
    float share = s[n].w > 0.5 ? 1.0 / float(SAMPLES) : 0.0;
    covered += share;
    land += s[n].w < -0.5 ? 1.0 / float(SAMPLES) : 0.0;
    bool is_near = abs(abs(s[n].z) - abs(near.z)) < abs(abs(s[n].z) - abs(far.z));
    near_share += is_near ? share : 0.0;
  }
  vec3 colour = mix(shade(far, direction), shade(near, direction), near_share / max(covered, 1e-3));
#if UNDERSIDE
  if (eye.z < 0.0) {
    colour = mix(water_body(direction), colour, covered);
    covered = 1.0;
  }
#endif
  covered = min(covered / max(1.0 - land, 1e-3), 1.0);  // of what land, drawn later, leaves
  radiance = vec4(colour * covered, covered);
#else
  vec4 s = texelFetch(surface_map, pixel, 0);
  vec3 colour = shade(s, direction);
#if UNDERSIDE
  if (eye.z < 0.0 && s.w < 0.5) colour = water_body(direction);
#endif
#if SAMPLES == 1
  if (s.w < 0.5 && eye.z >= 0.0) discard;  // the sky beside a crest
#endif
  radiance = vec4(colour, 1.0);
#endif
}

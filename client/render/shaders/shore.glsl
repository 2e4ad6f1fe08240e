// What land does to the look of the sea: the bottom that shines through, surf, and land in the
// water's mirror. Needs waves.glsl and ground.glsl.

// The bottom as it is seen through the surface.
struct Shallow {
  Ground ground;
  float depth;  // of the water under the surface point, negative on land [m]
  float slope;  // of the ground there
  vec3 bottom;  // radiance that it sends up through the surface
  vec3 shown;   // its share in the water's own colour
};

// Bottom and water share the light that comes out of a shallow sea (Maritorena, Morel & Gentili 1994):
// both dim with the way down and up. The ray is bent by the mean surface.
Shallow shallow_at(vec2 place, float distance, vec3 direction, vec3 n, float footprint_log2) {
  float height = eye.z + direction.z * distance + dot(place, place) / (2.0 * kEarthRadius);
  float lod = max(footprint_log2 - ground_noise.z, 0.0);
  vec4 here = ground_at(place, lod);
  Shallow s;
  s.depth = height - here.x;
  s.slope = length(here.yz);
  vec3 r = refract(direction, n, 1.0 / 1.34);
  float down = max(-r.z, 0.35);
  vec2 at = place + r.xy * (clamp(s.depth, 0.0, 30.0) / down);
  vec4 there = ground_at(at, lod);
  float deep = max(height - there.x, 0.0);
  s.shown = exp(-water_kd.rgb * (deep + deep / down));
  // What is looked at through water is always wet.
  there.x = min(there.x, here.x);
  s.ground = ground_of(at, there, footprint_log2);
  float lit = max(dot(s.ground.normal, vec3(0.0, 0.0, 1.0)), 0.0);
  // ground_of() has darkened it as wet: half of that is the surface's doing, which is counted here.
  s.bottom = bottom_irradiance.rgb * s.ground.albedo * (2.0 * lit);
  return s;
}

// Share of the surface that breaks because the water is shallow: most of it on the crests, and the
// last of it as a seam where the water ends. Where waves are as high as the depth lets them be they
// break: see kBreakerIndex in common/sea/shoaling.h.
float surf_at(float depth, Waves w) {
#if ATTENUATED
  float hs = w.hs;
#else
  float hs = water_kd.w;
#endif
  float breaking = (1.0 - smoothstep(1.7, 2.8, depth / max(hs, 0.01))) * smoothstep(0.04, 0.3, hs);
  float crest = smoothstep(-0.1, 0.3, -4.0 * w.squeeze);
  float seam = (1.0 - smoothstep(0.02, 0.10 + 0.1 * water_kd.w, depth)) * smoothstep(0.1, 0.6, water_kd.w);
  return max(breaking * (0.25 + 0.55 * crest), 0.42 * seam);
}

// Land in the water's mirror: where the ground rises above the reflected ray, at a few distances.
vec3 with_land(vec3 sky, vec2 place, float height, vec3 r, float deviation) {
  float run = max(length(r.xy), 1e-3);
  vec2 ahead = r.xy / run;
  float slope = abs(r.z) / run, hidden = 0.0, tall = 0.0;
  for (int n = 0; n < 3; ++n) {
    float far = 6.0 * pow(5.0, float(n)), lod = max(log2(far * 0.25) - ground_noise.z, 0.0);
    float rise = ground_at(place + ahead * far, lod).x - height;
    float over = rise - slope * far;
    hidden = max(hidden, smoothstep(-0.5, 0.5, over / (far * (0.10 + 1.5 * deviation))) * smoothstep(0.2, 1.0, rise));
    tall = max(tall, rise);
  }
  vec3 albedo = mix(vec3(0.17, 0.155, 0.125), vec3(0.085, 0.09, 0.04), smoothstep(2.5, 8.0, tall));
  // Seen from below it is in the sky's light, and in the sun's when that is behind the eye.
  float lit = 0.30 - 0.25 * dot(ahead, sun_direction.xy);
  vec3 land = albedo / kPi * (0.75 * sky_irradiance.rgb + sun_irradiance.rgb * lit);
  return mix(sky, land, hidden);
}

// By how much land and shallow water lower the waves of a cascade at a place (common/sea/attenuation.h).
uniform sampler2DArray attenuation_map;

// Planes 4 n to 4 n + 3 at the undisplaced point `xy`, relative to the eye.
vec4 wave_factors(vec2 xy, int n) {
  return textureLod(attenuation_map, vec3(xy * attenuation_place.zw + attenuation_place.xy, float(n)), 0.0);
}

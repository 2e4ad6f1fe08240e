// Radiance to display: exposure, glow, a filmic curve that bleaches highlights, sRGB, dither.
uniform sampler2D scene;
uniform sampler2D glow;
uniform float glow_share;
in vec2 picture;
out vec4 colour;

// The film's white is noon's sun and sky together, not the sun above the air.
const vec3 kDaylight = vec3(0.95, 1.0, 1.12);

// Crosstalk before the curve: bright colours drift to white as film does, instead of clipping.
vec3 filmic(vec3 x) {
  float luminance = dot(x, vec3(0.2126, 0.7152, 0.0722));
  x = mix(x, vec3(luminance), 0.10);
  // x^c / (x^c + m^c): a response curve whose slope at mid grey is the contrast c.
  // With c = 5/4 the power is two roots.
  const float kMiddlePower = 0.484;  // 0.56^c
  x = max(x, vec3(0.0));
  vec3 p = x * sqrt(sqrt(x));
  vec3 y = p / (p + kMiddlePower);
  float grey = dot(y, vec3(0.2126, 0.7152, 0.0722));
  return clamp(mix(vec3(grey), y, 1.14), 0.0, 1.0);
}

// The power 1/2.4 from three roots, within half a step of 255: roots are cheap, powers are not.
vec3 to_srgb(vec3 x) {
  vec3 root = sqrt(x), root4 = sqrt(root), root8 = sqrt(root4);
  vec3 curve = 0.585122381 * root + 0.783140355 * root4 - 0.368262736 * root8;
  return mix(12.92 * x, curve, step(0.0031308, x));
}

float noise(vec2 at) { return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715)))); }

void main() {
  vec2 at = 0.5 * picture + 0.5;
  vec3 x = texelFetch(scene, ivec2(gl_FragCoord.xy), 0).rgb;
  x = mix(x, texture(glow, at).rgb, glow_share);
  x *= sun_irradiance.w * kDaylight;
  vec3 y = to_srgb(filmic(x));
  float dither = noise(gl_FragCoord.xy) - 0.5;
  colour = vec4(y + dither / 255.0, 1.0);
}

// One drop or puff of a burst of spray: a quad that faces the eye, drawn out along its flight.
//
// Drag that grows with speed gives a drop the time constant tau and the fall tau g:
//   x(t) = x0 + u t + (v0 - u) tau (1 - exp(-t / tau)),  u = wind - tau g
layout(location = 0) in vec4 place_age;      // relative to the eye's place on the water [m]; age [s]
layout(location = 1) in vec4 velocity_mass;  // [m/s]; [kg]
layout(location = 2) in float seed;
uniform vec4 wind_now;  // xyz: [m/s]; w: life [s]
out vec2 corner;      // [-1, 1]
out vec2 noise_at;
out vec3 offset_eye;
out float depth;      // along the view [m]
out float opacity;
out float soft_m;

uint state;
float draw() {
  state = state * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return float((word >> 22u) ^ word & 0xffffu) / 66559.0;
}

void main() {
  int drop = gl_InstanceID % kDrops;
  state = floatBitsToUint(seed) + uint(drop) * 9781u;
  draw();
  bool mist = drop % 4 == 3;
  float mass = velocity_mass.w, size = 0.55 + 0.22 * log2(1.0 + mass);
  vec3 toss = vec3(draw() - draw(), draw() - draw(), draw() - draw());
  float speed = length(velocity_mass.xyz);
  vec3 v0 = velocity_mass.xyz * (0.55 + 0.75 * draw()) + toss * (0.45 * speed + 0.4);
  float tau = mist ? 0.10 + 0.20 * draw() : 0.45 + 0.7 * draw();
  float life = wind_now.w * (mist ? 0.6 + 0.4 * draw() : 0.35 + 0.4 * draw());
  float age = place_age.w, left = 1.0 - age / life;

  vec3 u = wind_now.xyz - vec3(0.0, 0.0, 9.81 * tau);
  float slowed = exp(-age / tau);
  vec3 centre = place_age.xyz + 0.35 * size * toss + u * age + (v0 - u) * (tau * (1.0 - slowed));
  vec3 flight = u + (v0 - u) * slowed;
  float radius = size * (mist ? 0.16 + 0.60 * age : 0.03 + 0.07 * draw() + 0.10 * age);
  float length_m = radius + (mist ? 0.0 : 0.030 * length(flight));

  vec3 to = centre - eye.xyz;
  vec3 side = normalize(cross(to, flight) + vec3(1e-5, 0.0, 0.0));
  vec3 along = normalize(cross(side, to));
  corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec3 world = centre + side * (radius * corner.x) + along * (length_m * corner.y);
  offset_eye = world - eye.xyz;
  noise_at = corner * (mist ? 0.06 : 0.035) + vec2(draw(), draw());
  opacity = (mist ? 0.07 : 0.42) * sqrt(max(left, 0.0)) * min(1.0, 0.35 + age * 12.0);
  opacity *= radius * radius / ((radius + 0.01) * length_m);
  soft_m = radius;
  gl_Position = clip_from_world * vec4(world, 1.0);
  depth = gl_Position.w;
  gl_Position.z = -kNearest;
  bool drawn = left > 0.0 && float(drop) < 8.0 + 6.0 * log2(1.0 + mass);
  if (!drawn || depth < 0.3) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}

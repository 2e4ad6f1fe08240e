// Logarithmic depth: centimetres at the lens, and no fighting between waves kilometres away. 0 is the
// eye's plane, 1 is 120 km along the view, or nothing there.
const float kDepthPerM = 8.0;
const float kDepthMaxM = 120000.0;

float log_depth(float along_m) {
  return log2(max(1e-6, 1.0 + along_m * kDepthPerM)) / log2(1.0 + kDepthMaxM * kDepthPerM);
}

// Metres along the view, from what log_depth() made of them.
float depth_of(float stored) {
  return (exp2(stored * log2(1.0 + kDepthMaxM * kDepthPerM)) - 1.0) / kDepthPerM;
}

#pragma once

/// Elementary functions that give the same bits on every IEEE-754 machine, compiler and
/// optimisation level.
///
/// Problem: libm is not correctly rounded, so two machines disagree in the last bit of exp() and
/// the sea with them. Idea: use only operations that IEEE-754 rounds exactly (+ - * / sqrt,
/// comparisons) and integers, in a fixed order. Limits: needs -ffp-contract=off, round-to-nearest
/// and no flushing of subnormals (CheckFpEnvironment, fp_env.h).
///
///   function   bound of the error [ulp]   domain
///   Exp        0.75                       all, subnormal results included
///   Log        0.95                       all; Log(x < 0) is NaN
///   Sin, Cos   0.80                       all finite; NaN for infinities
///   Atan2      2.1                        all, signed zeros and infinities as in C
///   Sinh       1.8                        all
///   Tanh       2.4                        all
///   Pow        0.75                       all, special cases as in C (IEC 60559)
///
/// tests/base/real_math_test.cc asserts these bounds. Cost: 10-40 ns a call. Thread-safe.
namespace onesea::real {

double Exp(double x);
double Log(double x);
double Pow(double x, double y);
double Sinh(double x);
double Tanh(double x);

double Sin(double x_rad);
double Cos(double x_rad);
/// Angle of the vector (x, y), in [-π, π]. Note the order of arguments, that of C.
double Atan2(double y, double x);

struct SinCosPair {
  double sin = 0.0;
  double cos = 1.0;
};
/// Both with one argument reduction; the same bits as Sin() and Cos().
SinCosPair SinCos(double x_rad);

}  // namespace onesea::real

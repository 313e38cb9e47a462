// Exact numbers m 2^e: doubles are dyadic, and sums and products of dyadic numbers are dyadic again. Every decision of
// this folder is the sign of a polynomial in the doubles given, so no division and hence no common factor is ever
// needed.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace surefoot::stability {

class Dyadic {
 public:
  Dyadic() = default;
  /// Exact for every finite double.
  Dyadic(double value);                                      // NOLINT: a double is a dyadic number
  Dyadic(int value) : Dyadic(static_cast<double>(value)) {}  // NOLINT

  // Numbers of up to 512 bits live on the stack: products of four doubles, sums of such.
  using Integer = boost::multiprecision::number<
      boost::multiprecision::cpp_int_backend<512, 0, boost::multiprecision::signed_magnitude,
                                             boost::multiprecision::unchecked,
                                             std::allocator<boost::multiprecision::limb_type>>,
      boost::multiprecision::et_off>;
  const Integer& mantissa() const { return mantissa_; }
  long exponent() const { return exponent_; }
  int sign() const { return mantissa_.sign(); }
  bool is_zero() const { return sign() == 0; }

  friend Dyadic operator-(Dyadic a);
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + -b; }
  friend bool operator<(const Dyadic& a, const Dyadic& b) { return (a - b).sign() < 0; }
  friend bool operator>(const Dyadic& a, const Dyadic& b) { return b < a; }
  friend bool operator>=(const Dyadic& a, const Dyadic& b) { return !(a < b); }
  friend Dyadic abs(const Dyadic& a) { return a.sign() < 0 ? -a : a; }

 private:
  Dyadic(Integer mantissa, long exponent) : mantissa_(std::move(mantissa)), exponent_(exponent) {}
  static Dyadic sum(const Dyadic& high, const Dyadic& low);

  Integer mantissa_ = 0;
  long exponent_ = 0;
};

}  // namespace surefoot::stability

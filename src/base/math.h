// Small vectors, quaternions and matrices, and the few transcendental functions whose bits the simulation's state
// depends on.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace brisance {

constexpr double pi = 3.14159265358979323846;

template <class T>
struct Vec2 {
  T x{}, y{};
  friend bool operator==(const Vec2&, const Vec2&) = default;
  friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2 operator*(Vec2 a, T s) { return {a.x * s, a.y * s}; }
};
using Vec2d = Vec2<double>;

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr Vec3() = default;
  constexpr Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  template <class S>
  explicit constexpr Vec3(const Vec3<S>& v) : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}

  T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  const T& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  friend bool operator==(const Vec3&, const Vec3&) = default;
  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  /// Component by component (colours, cell sizes).
  friend constexpr Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(T s, const Vec3& a) { return a * s; }
  friend constexpr Vec3 operator/(const Vec3& a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
  Vec3& operator-=(const Vec3& b) { return *this = *this - b; }
  Vec3& operator*=(T s) { return *this = *this * s; }
};
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Vec3i = Vec3<int>;

template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(const Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}
/// Unit vector along a; a itself where its length is zero.
template <class T>
Vec3<T> normalized(const Vec3<T>& a) {
  const T l = length(a);
  return l > T(0) ? a / l : a;
}
template <class T>
Vec3<T> min(const Vec3<T>& a, const Vec3<T>& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
template <class T>
Vec3<T> max(const Vec3<T>& a, const Vec3<T>& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
template <class T>
bool isFinite(const Vec3<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Axis-aligned box; empty until something is added.
struct Box3 {
  Vec3d lower{1e300, 1e300, 1e300}, upper{-1e300, -1e300, -1e300};
  void include(const Vec3d& p) {
    lower = min(lower, p);
    upper = max(upper, p);
  }
  Vec3d size() const { return upper - lower; }
  bool contains(const Vec3d& p) const {
    return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y && p.z >= lower.z && p.z <= upper.z;
  }
  friend bool operator==(const Box3&, const Box3&) = default;
};

/// 3x3 matrix by rows.
struct Mat3 {
  Vec3d row[3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  friend bool operator==(const Mat3& a, const Mat3& b) {
    return a.row[0] == b.row[0] && a.row[1] == b.row[1] && a.row[2] == b.row[2];
  }
  friend Vec3d operator*(const Mat3& m, const Vec3d& v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
  }
  friend Mat3 operator*(const Mat3& a, const Mat3& b) {
    const Mat3 t = transpose(b);
    Mat3 r;
    for (auto& rowOut : r.row) {
      const Vec3d& rowA = a.row[&rowOut - r.row];
      rowOut = {dot(rowA, t.row[0]), dot(rowA, t.row[1]), dot(rowA, t.row[2])};
    }
    return r;
  }
  friend Mat3 operator*(const Mat3& a, double s) { return {{a.row[0] * s, a.row[1] * s, a.row[2] * s}}; }
  friend Mat3 operator+(const Mat3& a, const Mat3& b) {
    return {{a.row[0] + b.row[0], a.row[1] + b.row[1], a.row[2] + b.row[2]}};
  }
  friend Mat3 transpose(const Mat3& m) {
    return {{{m.row[0].x, m.row[1].x, m.row[2].x},
             {m.row[0].y, m.row[1].y, m.row[2].y},
             {m.row[0].z, m.row[1].z, m.row[2].z}}};
  }
  friend double determinant(const Mat3& m) { return dot(m.row[0], cross(m.row[1], m.row[2])); }
  /// Inverse; the caller knows that the determinant is not zero.
  friend Mat3 inverse(const Mat3& m) {
    const double d = determinant(m);
    return transpose(
        Mat3{{cross(m.row[1], m.row[2]) / d, cross(m.row[2], m.row[0]) / d, cross(m.row[0], m.row[1]) / d}});
  }
};

/// Rotation w + xi + yj + zk, unit length.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;

  friend bool operator==(const Quaternion&, const Quaternion&) = default;
  friend Quaternion operator*(const Quaternion& a, const Quaternion& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
  }
  friend Quaternion conjugate(const Quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }
  friend Quaternion normalized(const Quaternion& q) {
    const double l = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / l, q.x / l, q.y / l, q.z / l};
  }
  friend Mat3 rotationMatrix(const Quaternion& q) {
    const double w = q.w, x = q.x, y = q.y, z = q.z;
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
             {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
             {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
  }
  friend Vec3d rotate(const Quaternion& q, const Vec3d& v) { return rotationMatrix(q) * v; }
};

/// Where a body is: point p of the body lies at rotate(orientation, p) + position.
struct Pose {
  Vec3d position;
  Quaternion orientation;
  friend bool operator==(const Pose&, const Pose&) = default;
  friend Vec3d operator*(const Pose& pose, const Vec3d& p) { return rotate(pose.orientation, p) + pose.position; }
};

/// exp, log, sine/cosine and arc tangent in double from +, -, *, / alone: the same bits on every processor, where the C
/// library picks variants with fused multiply-add by what it runs on. Relative error below 1e-15.
double portableExp(double x);
double portableLog(double x);  ///< of x > 0
struct SinCos {
  double sin, cos;
};
SinCos portableSinCos(double radians);  ///< |radians| below 1e5
/// Angle of the point (x, y) from the x axis, from -pi to pi [radians]; 0 at the origin.
double portableAtan2(double y, double x);

/// Rotation by an angle [radians] about a unit axis.
Quaternion axisAngle(const Vec3d& axis, double radians);

}  // namespace brisance

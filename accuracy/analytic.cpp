#include "accuracy/analytic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace voxmelt::accuracy {
namespace {

constexpr double kPi = std::numbers::pi;

// Finds the root of an increasing function that is below 0 at `low`.
template <class Function>
double bisect(double low, double high, const Function& function) {
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (function(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Gives the integral of (1 - s^2)^(1/3) over 0..1.
double plane_profile_area() { return std::sqrt(kPi) / 2 * std::tgamma(4.0 / 3) / std::tgamma(11.0 / 6); }

// The profile is Huppert's for a current of constant flux. It is h ~ phi(y) with y = r / front, where
//   (y phi^3 phi')' + y^2 phi' / 2 = 0,   phi -> (3/2 (1 - y))^(1/3) at the front.
// If M(y) is the integral of s phi over s = y..1, a first integral is y phi^3 phi' = -M - y^2 phi / 2. It is
// regular from the front inwards in s = -log y, for psi = phi^3:  dpsi/ds = 3 M / phi + 3 y^2 / 2,  dM/ds =
// y^2 phi.
struct FedProfile {
  static constexpr double kStep = 1e-3,
                          kEnd = 12;  // end of s; within exp(-12) of the front there is no volume left

  double front = 0;       // (2 pi M(0))^(-3/8)
  double rms_radius = 0;  // root of the mean of y^2
  std::vector<double> phis{0};

  static const FedProfile& get() {
    static const FedProfile profile;
    return profile;
  }
  double phi(double y) const {
    if (y >= 1) return 0;
    const double at = std::min(-std::log(std::max(y, 1e-300)), kEnd - 2 * kStep) / kStep;
    const auto i = static_cast<std::size_t>(at);
    return phis[i] + (at - static_cast<double>(i)) * (phis[i + 1] - phis[i]);
  }

 private:
  struct Rates {
    double psi, volume, second;
  };
  static Rates rates(double s, double psi, double volume) {
    const double y2 = std::exp(-2 * s), phi = std::cbrt(psi);
    return {(psi > 0 ? 3 * volume / phi : 0) + 1.5 * y2, y2 * phi, y2 * y2 * phi};
  }
  FedProfile() {
    double psi = 0, volume = 0, second = 0;
    for (double s = 0; s < kEnd; s += kStep) {  // Runge-Kutta, fourth order
      const Rates a = rates(s, psi, volume);
      const auto half = [&](const Rates& r) {
        return rates(s + kStep / 2, psi + kStep / 2 * r.psi, volume + kStep / 2 * r.volume);
      };
      const Rates b = half(a), c = half(b),
                  d = rates(s + kStep, psi + kStep * c.psi, volume + kStep * c.volume);
      psi += kStep / 6 * (a.psi + 2 * b.psi + 2 * c.psi + d.psi);
      volume += kStep / 6 * (a.volume + 2 * b.volume + 2 * c.volume + d.volume);
      second += kStep / 6 * (a.second + 2 * b.second + 2 * c.second + d.second);
      phis.push_back(std::cbrt(psi));
    }
    front = std::pow(2 * kPi * volume, -0.375);
    rms_radius = std::sqrt(second / volume);
  }
};

}  // namespace

double diffusivity(double gamma, int neighbours) {
  return gamma / kPi * (neighbours == 6 ? 1 : neighbours == 18 ? 3 : 13.0 / 3);
}

double stefan_lambda(double stefan) {
  return bisect(0, 10, [&](double lambda) {
    return lambda * std::exp(lambda * lambda) * std::erf(lambda) - stefan / std::sqrt(kPi);
  });
}

double stefan_lambda(double stefan, double stefan_solid) {
  return bisect(1e-9, 5, [&](double lambda) {
    const double gauss = std::exp(-lambda * lambda);
    return lambda * std::sqrt(kPi) - stefan * gauss / std::erf(lambda) +
           stefan_solid * gauss / std::erfc(lambda);
  });
}

double stefan_temperature(double x, double time, double diffusivity, double stefan, double stefan_solid) {
  const double lambda = stefan_lambda(stefan, stefan_solid);
  const double at = x / (2 * std::sqrt(diffusivity * time));
  if (at < lambda) return 1 - std::erf(at) / std::erf(lambda);
  return -stefan_solid / stefan * (1 - std::erfc(at) / std::erfc(lambda));
}

double slab_temperature(double x, double time, double diffusivity, double depth) {
  double sum = 0;
  for (int n = 0; n < 200; ++n) {
    const double k = (n + 0.5) * kPi / depth;
    sum += 2 / (k * depth) * std::sin(k * x) * std::exp(-diffusivity * k * k * time);
  }
  return 1 - sum;
}

double Drop::front(double time) const {
  const double constant = std::pow(1024 / (81 * kPi * kPi * kPi), 0.125);
  return constant * std::pow(kappa * volume * volume * volume / 3 * time, 0.125);
}
double Drop::rms_radius(double time) const { return front(time) * std::sqrt(3.0 / 7); }
double Drop::height(double radius, double time) const {
  const double end = front(time), s = radius / end;
  return s < 1 ? 4 * volume / (3 * kPi * end * end) * std::cbrt(1 - s * s) : 0;
}
double Drop::time_of_front(double wanted) const { return std::pow(wanted / front(1), 8); }

double Dam::front(double time) const {
  const double constant = std::pow(std::cbrt(0.3) * plane_profile_area(), -0.6);
  return constant * std::pow(kappa * area * area * area / 3 * time, 0.2);
}
double Dam::height(double x, double time) const {
  const double end = front(time), s = x / end;
  return s < 1 ? area / (end * plane_profile_area()) * std::cbrt(1 - s * s) : 0;
}
double Dam::time_of_front(double wanted) const { return std::pow(wanted / front(1), 5); }

double Dam::rms_length(double time) const { return front(time) * std::sqrt(3.0 / 11); }

Dam dam_of_depth(double kappa, double depth, double front) {
  return {kappa, depth * front * plane_profile_area()};
}

std::vector<double> lubrication_flow(double kappa, std::vector<double> depth, double time,
                                     int parts_per_cell) {
  // The steps are implicit and linearised: the conductance between two parts is that of the state before.
  const std::size_t n = depth.size();
  std::vector<double> g(n), c(n), d(n);
  for (double done = 0, step = 0; done < time; done += step) {
    step = std::min(time - done, std::max(1e-6 * time, done / 200));
    const double scale = kappa / 3 * parts_per_cell * parts_per_cell * step;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double a = depth[i], b = depth[i + 1];
      g[i] = scale * (a + b) * (a * a + b * b) / 4;  // the mean of h^3 over a linear profile
    }
    // Thomas's algorithm solves (1 + g[i - 1] + g[i]) h[i] - g[i - 1] h[i - 1] - g[i] h[i + 1] = old h[i].
    for (std::size_t i = 0; i < n; ++i) {
      const double left = i > 0 ? g[i - 1] : 0, right = i + 1 < n ? g[i] : 0;
      const double pivot = 1 + left + right - (i > 0 ? left * c[i - 1] : 0);
      c[i] = right / pivot;
      d[i] = (depth[i] + (i > 0 ? left * d[i - 1] : 0)) / pivot;
    }
    depth[n - 1] = d[n - 1];
    for (std::size_t i = n - 1; i-- > 0;) depth[i] = d[i] + c[i] * depth[i + 1];
  }
  return depth;
}

double FedCurrent::front(double time) const {
  return FedProfile::get().front * std::pow(kappa * flux * flux * flux / 3, 0.125) * std::sqrt(time);
}
double FedCurrent::rms_radius(double time) const { return FedProfile::get().rms_radius * front(time); }
double FedCurrent::height(double radius, double time) const {
  const FedProfile& profile = FedProfile::get();
  return std::pow(profile.front, 2.0 / 3) * std::pow(3 * flux / kappa, 0.25) *
         profile.phi(radius / front(time));
}

double nusselt(double slope) {
  const double stretch = 1 + slope * slope;
  return slope / (stretch * stretch);
}

double cylinder_film(double kappa, double flux, double angle) {
  return std::cbrt(3 * flux / (kappa * std::sin(angle)));
}

// Solves open_area h + roofed_area (ceiling + (h - ceiling) / stiffness) = volume for h.
double conduit_level(double volume, double open_area, double roofed_area, double ceiling, double stiffness) {
  const double squeezed = roofed_area / stiffness;
  return (volume - ceiling * (roofed_area - squeezed)) / (open_area + squeezed);
}

double ball_intercepts(double radius, double distance) {
  const double sine = radius / distance;
  return 2 * kPi * (1 - std::sqrt(1 - sine * sine));
}

}  // namespace voxmelt::accuracy

#include "gas_arrays.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace meshless::hydrodynamics {

namespace {

constexpr std::size_t room_for_images = 256;

void require(bool condition, const std::string &message) {
  if (!condition)
    throw std::invalid_argument(message);
}

void check(const GasParticles &p, const GasOptions &options) {
  const std::size_t n = p.mass.size();
  require(n >= 2, "a gas needs two particles or more");
  require(p.position.size() == n && p.velocity.size() == n && p.density.size() == n && p.energy.size() == n,
          "the arrays of a gas have different lengths");
  for (std::size_t i = 0; i < n; ++i) {
    const auto name = [&] { return fmt::format("particle {} at x = {:.6g} m", i + 1, p.position[i]); };
    require(std::isfinite(p.position[i]) && std::isfinite(p.velocity[i]), name() + ": a value is not finite");
    require(p.mass[i] > 0 && std::isfinite(p.mass[i]), name() + " has a mass that is not positive");
    require(p.density[i] > 0 && std::isfinite(p.density[i]), name() + " has a density that is not positive");
    require(p.energy[i] > 0 && std::isfinite(p.energy[i]), name() + " has an internal energy that is not positive");
    require(i == 0 || p.position[i - 1] < p.position[i], name() + " does not lie behind the one before it");
  }
  if (options.adaptive)
    require(options.smoothing > 0, fmt::format("the smoothing length {} m / rho is not positive", options.smoothing));
  else
    require(options.fixed_length > 0, fmt::format("the smoothing length {} m is not positive", options.fixed_length));
  require(options.ends[0] == End::free || p.position.front() > options.walls[0],
          "the left wall is not left of the gas");
  require(options.ends[1] == End::free || p.position.back() < options.walls[1],
          "the right wall is not right of the gas");
}

} // namespace

GasArrays::GasArrays(const GasParticles &particles, const GasOptions &options) {
  check(particles, options);
  for (std::size_t side = 0; side < 2; ++side)
    room_[side] = options.ends[side] == End::mirror ? room_for_images : 0;
  begin_ = room_[0];
  end_ = begin_ + particles.mass.size();
  const std::size_t n = end_ + room_[1] + padding + 2 * block_size;
  far_ = 1e6 * (particles.position.back() - particles.position.front());
  const auto field = [&](const std::vector<double> &values, double elsewhere) {
    Field result(n, elsewhere);
    for (std::size_t i = 0; i < values.size(); ++i)
      result[begin_ + i] = values[i];
    return result;
  };
  mass = field(particles.mass, 0);
  position = field(particles.position, particles.position.back() + far_);
  velocity = field(particles.velocity, 0);
  energy = field(particles.energy, 1);
  density = field(particles.density, 1);
  smoothing_length = Field(n, 1e-3 * far_);
  predicted_velocity = predicted_energy = pressure = sound_speed = pressure_term = Field(n, 0);
  force = compression = acceleration = energy_rate = Field(n, 0);
  if (options.density == DensityRule::continuity)
    start_density = density_rate = Field(n, 0);
  if (options.viscosity)
    viscous_work = Field(n, 0);
  if (options.conduction)
    heat = Field(n, 0);
  if (options.burn)
    start_position = particles.position;
}

Fields GasArrays::fields() {
  return {.position = position.data(),
          .smoothing_length = smoothing_length.data(),
          .mass = mass.data(),
          .velocity = velocity.data(),
          .energy = energy.data(),
          .sound_speed = sound_speed.data(),
          .pressure_term = pressure_term.data(),
          .density = density.data(),
          .force = force.data(),
          .compression = compression.data(),
          .viscous_work = viscous_work.data(),
          .heat = heat.data(),
          .pair_gradient = pair_gradient.data(),
          .pair_viscous = pair_viscous.data()};
}

bool GasArrays::place_images(const GasOptions &options, double reach) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (options.ends[side] == End::free)
      continue;
    std::size_t count = 0;
    // A pair of a particle and an image is within reach if both are; the largest h beside the wall decides.
    double longest = 0;
    const auto source = [&](std::size_t k) { return side == 0 ? begin_ + k : end_ - 1 - k; };
    const std::size_t n = end_ - begin_;
    while (count < n) {
      const std::size_t i = source(count);
      longest = std::max(longest, smoothing_length[i]);
      if (std::abs(position[i] - options.walls[side]) > reach * longest)
        break;
      ++count;
    }
    if (count > room_[side])
      return false;
    if (side == 1) // what were images become far particles again
      for (std::size_t k = count; k < n_images_[1]; ++k) {
        position[end_ + k] = position[end_ - 1] + far_;
        mass[end_ + k] = 0;
      }
    n_images_[side] = count;
  }
  for_images([&](std::size_t image, std::size_t source, std::size_t side) {
    position[image] = 2 * options.walls[side] - position[source];
    mass[image] = mass[source];
    smoothing_length[image] = smoothing_length[source];
  });
  return true;
}

void GasArrays::copy_images() {
  for_images([&](std::size_t image, std::size_t source, std::size_t) {
    density[image] = density[source];
    pressure_term[image] = pressure_term[source];
    sound_speed[image] = sound_speed[source];
    predicted_energy[image] = predicted_energy[source];
    force[image] = compression[image] = 0;
    if (viscous_work.size() > 0)
      viscous_work[image] = 0;
    if (heat.size() > 0)
      heat[image] = 0;
  });
  reverse_images(predicted_velocity);
}

void GasArrays::reverse_images(Field &of) const {
  for_images([&](std::size_t image, std::size_t source, std::size_t) { of[image] = -of[source]; });
}

dynamics::State GasArrays::state(const GasOptions &options) {
  dynamics::State all;
  const auto add = [&](const char *name, Field &field) { all.push_back({name, {&field[begin_], end_ - begin_}}); };
  add("position", position);
  add("velocity", velocity);
  add("energy", energy);
  add("density", density);
  add("smoothing_length", smoothing_length);
  add("sound_speed", sound_speed);
  add("acceleration", acceleration);
  add("energy_rate", energy_rate);
  if (options.density == DensityRule::continuity)
    add("density_rate", density_rate);
  return all;
}

std::size_t GasArrays::bytes() const {
  std::size_t n = start_position.capacity() + pair_gradient.capacity() + pair_viscous.capacity();
  for (const Field *field : {&mass, &position, &velocity, &energy, &density, &smoothing_length, &predicted_velocity,
                             &predicted_energy, &start_density, &pressure, &sound_speed, &pressure_term, &force,
                             &compression, &acceleration, &energy_rate, &density_rate, &viscous_work, &heat})
    n += field->size();
  return n * sizeof(double);
}

} // namespace meshless::hydrodynamics

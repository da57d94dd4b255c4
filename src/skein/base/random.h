// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace skein {

/// What a random stream is for. Each purpose of each entity has a stream of its own, so
/// that adding a sensor never shifts another's noise. Append only: the numbers are part
/// of what makes an old run repeatable.
enum class Purpose : std::uint32_t {
  kTest = 0,
  kFireShape = 1,
  kFireRate = 2,
  kGnss = 3,
  kFireSensor = 4,
  kRadio = 5,
  kEnsemble = 6,
  kParticles = 7,
  kStudy = 8,
  kTerrain = 9,
  kAgent = 10,
  kAirData = 11,
  kFireFuel = 12,
  kGnssReceiver = 13,
  kGnssOutage = 14,
  kImu = 15,
  kBarometer = 16,
  kMagnetometer = 17,
  kPitot = 18,
  kHeight = 19,
  kRange = 20,
  kLidar = 21,
  kAnemometer = 22,
  kCamera = 23,
  kPower = 24,
  kTurbulence = 25,
  kObject = 26,
  kRadioOutage = 27,
  kOutsideSensors = 28,
  kAllocation = 29,
  kTeam = 30,
  kTraffic = 31,
  kTrafficSensor = 32,
  kPilot = 33,
  kVehicleFault = 40,
  kAirframe = 41,
  /// Kinds of plugins: this and every number above it, as `static_cast<Purpose>(...)`.
  kPlugin = 0x4000,
};

/// A stream of independent random numbers, by counter: number k of the stream is a pure
/// function of (seed, entity, purpose, instance, k), whatever thread asks and in whatever
/// order streams are used. Generator: Philox4x32-10 (Salmon et al. 2011), 2^64 blocks.
class RandomStream {
 public:
  /// @param instance  distinguishes several of one purpose, such as two equal sensors of
  ///                  one aircraft; below 65,536. The first one is 0, so that another one
  ///                  does not change its numbers.
  RandomStream(std::uint64_t seed, std::uint32_t entity, Purpose purpose,
               std::uint32_t instance = 0);

  /// Uniform over all 64-bit numbers.
  std::uint64_t bits();
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal (Box-Muller).
  double normal();

  /// Four independent standard normals, from one whole block: for noise at high rates.
  ///
  ///   r = sqrt(-2 ln u), (r cos a, r sin a),  u in (0, 1) and a of 32 bits each
  ///
  /// No number is further than 6.7 from 0. Only sums, products, quotients and square
  /// roots: the same bits on every machine. Does not touch what bits() and normal() still
  /// have of their block.
  /// Cost: a third of four calls of normal(); see bench/sensory_bench.cpp.
  std::array<double, 4> normals4();

  /// Continues at block `index` of the stream (two 64-bit numbers a block), so that a
  /// stream can be addressed by, say, message number.
  void seek(std::uint64_t index);

 private:
  void refill();
  std::array<std::uint32_t, 4> next_block();

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 2> stream_;
  std::uint64_t index_ = 0;
  std::array<std::uint64_t, 2> block_{};
  int left_ = 0;
  double spare_normal_ = 0;
  bool has_spare_ = false;
};

/// Independent standard normals one by one, made four at a time (RandomStream::normals4).
class FastNormals {
 public:
  explicit FastNormals(const RandomStream& stream) : stream_(stream) {}

  double operator()() {
    if (left_ == 0) {
      block_ = stream_.normals4();
      left_ = 4;
    }
    return block_[--left_];
  }

 private:
  RandomStream stream_;
  std::array<double, 4> block_{};
  std::uint32_t left_ = 0;
};

}  // namespace skein

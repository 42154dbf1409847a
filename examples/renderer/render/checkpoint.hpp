// SPDX-License-Identifier: MIT
// A file that a rendering goes on from as if it had never stopped. Random numbers come from the
// seed and a sample's number, and the radii of merging from an iteration's, so that the film's sums
// and how far they are is all there is to keep. Invariant: what is at the path is a whole
// checkpoint of this rendering, or nothing of ours.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "../film/film.hpp"
#include "../integrators/counters.hpp"

namespace renderer {

/// How far a rendering is.
struct RenderState {
  std::uint64_t done = 0;              ///< samples of every pixel
  std::uint64_t last = 0;              ///< where the pass that was stopped was to end
  std::vector<std::uint8_t> finished;  ///< the tasks of that pass that are on the film
  double seconds = 0;                  ///< of rendering, in all runs
  Counters counters;                   ///< of all runs
};

class Checkpoint {
 public:
  /// `identity` names what must be the same for a rendering to go on to the same bits. Throws
  /// InputError where no file can be written.
  Checkpoint(std::string path, double every, std::map<std::string, std::string> identity);

  /// False if there is no such file. Throws InputError if what is there isn't a checkpoint, is
  /// damaged, or is of another rendering, and leaves it as it is.
  bool load(RenderState& state, Film& film) const;
  /// A failure (a full disk) is no reason to lose hours of work: it is noted, and the checkpoint
  /// before it stays.
  void save(const RenderState& state, const Film& film);
  /// Of a rendering that is complete.
  void remove();

  const std::string& path() const { return path_; }
  double every() const { return every_; }  ///< seconds
  const std::string& failure() const { return failure_; }

 private:
  std::string path_;
  double every_;
  std::map<std::string, std::string> identity_;
  std::string failure_;  // of the last save
};

}  // namespace renderer

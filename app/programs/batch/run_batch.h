/// Bakes many objects, each in a process of its own: what is done already is left, and one that fails stops no other.
///
/// A pack and its stamp appear by rename, the pack first, and the old stamp goes before the bake begins. So whenever a run is
/// killed, a stamp stands only beside the pack that it describes, and the next run goes on from there.
///
/// Threads  `jobs` threads, each of which waits for one bake; `tell` is called by one at a time.
/// Errors   none: what goes wrong with an object is in its row.
#pragma once

#include "app/programs/batch/collection.h"
#include "app/programs/batch/stamp.h"
#include "firmware_host/base/run_program.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen {

struct BatchPlan {
    std::vector<BatchObject> objects;
    std::filesystem::path output;          ///< folder of the packs
    std::vector<std::string> program;      ///< that bakes; INPUT and options follow
    std::string program_key;               ///< another one may bake other packs
    std::vector<std::string> bake_options; ///< the same for all objects
    bool pages = false;                    ///< a preview beside each pack
    bool bakes = true;                     ///< else it only looks at what is there
    std::size_t jobs = 1;
    ProgramLimits limits; ///< of each bake
};

/// A row for each object, in their order.
[[nodiscard]] std::vector<BatchRow> run_batch(const BatchPlan& plan,
                                              const std::function<void(const BatchRow&)>& tell);

} // namespace frustumscreen

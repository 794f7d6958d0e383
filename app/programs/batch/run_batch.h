/// Bakes many objects, each in a separate process: finished ones are skipped, and a failure does not stop the
/// others.
///
/// A pack and its stamp appear by rename, the pack first, and the old stamp is removed before the bake
/// begins. So whenever a run is killed, a stamp exists only next to the pack that it describes, and the next
/// run continues from there.
///
/// Threads  `jobs` threads, each of which waits for one bake; calls of `tell` are serialised.
/// Errors   none: an object's row reports its error.
#pragma once

#include "app/programs/batch/collection.h"
#include "app/programs/batch/stamp.h"
#include "firmware_host/base/run_program.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct BatchPlan {
    std::vector<BatchObject> objects;
    std::filesystem::path output;          ///< folder of the packs
    std::vector<std::string> program;      ///< command that bakes; INPUT and options are appended
    std::string program_key;               ///< identifies the program; another one may bake other packs
    std::vector<std::string> bake_options; ///< for all objects
    bool pages = false;                    ///< also bake a preview next to each pack
    bool bakes = true;                     ///< false: only check the existing results
    std::size_t jobs = 1;
    ProgramLimits limits; ///< for each bake
};

/// Returns a row for each object, in their order.
[[nodiscard]] std::vector<BatchRow> run_batch(const BatchPlan& plan,
                                              const std::function<void(const BatchRow&)>& tell);

} // namespace frustumscreen::programs

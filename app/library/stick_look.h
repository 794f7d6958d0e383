/// The look at a stick: finds its files, reads the set file and checks the signature of each pack. Nothing is
/// copied.
///
/// Errors   those of the stick as a whole are returned; those of one pack are in its line. Results from before
///          an error stay in the contents, for the report.
/// Threads  one caller.
#pragma once

#include "app/library/import_costs.h"
#include "app/library/import_stick.h"
#include "app/library/kiosk_keys.h"
#include "app/library/stick_contents.h"

#include <string>
#include <vector>

namespace frustumscreen::library {

class StickLook {
public:
    /// The references must outlive the look. `keys` gets the keys that the set file brings.
    StickLook(FileTree& stick, const ImportLimits& limits, const ImportEnvironment& outside, KioskKeys& keys,
              WastedWorkBudget& in_vain)
        : stick_(stick), limits_(limits), outside_(outside), keys_(keys), in_vain_(in_vain),
          began_(outside.now()) {}

    /// `known`: what was taken before.
    [[nodiscard]] ImportResult<void> run(StickContents& contents, const SetFile& known);

private:
    ImportResult<void> read_exhibit_file(StickContents& contents, const SetFile& known);
    ImportResult<void> look_at_packs(std::vector<StickPack>& packs, const std::vector<std::string>& paths);
    [[nodiscard]] bool is_too_late() const { return outside_.now() - began_ > limits_.look; }

    FileTree& stick_;
    const ImportLimits& limits_;
    const ImportEnvironment& outside_;
    KioskKeys& keys_;
    WastedWorkBudget& in_vain_;
    MonotonicTime began_; ///< the work on the kiosk's own disk before does not count
};

} // namespace frustumscreen::library

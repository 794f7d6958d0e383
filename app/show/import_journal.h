/// What the importer says of a stick, line by line for the journal: each stage, and in the end each pack.
///
/// Fields   DEVICE=stick; STATE is the line's text.
/// Threads  one caller, the render thread; a call writes `max_lines` at most, so that 500 packs cost no frame. Allocates nothing.
/// Errors   none.
#pragma once

#include "app/show/import_watch.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/service/journal.h"

#include <cstddef>
#include <functional>

namespace frustumscreen {

class ImportJournal {
public:
    static constexpr std::size_t max_lines = 16;
    using Write = std::function<void(LogPriority priority, const Sentence& line)>;

    /// Call once a second. What was over long before the exhibit began is not said again. An import that comes while the one before
    /// still has lines waits for them.
    void note(const SharedImport& import, const Write& write);

private:
    void note_packs(const Write& write);

    SharedImport noted_;
    std::size_t packs_ = 0; ///< of its packs, how many were said
};

} // namespace frustumscreen

/// The importer's progress as lines for the journal: each stage, and at the end each pack.
///
/// Fields   DEVICE=stick; STATE is the line's text.
/// Threads  one caller, the render thread; a call writes at most `max_lines`, so that 500 packs do not delay a
///          frame. Allocates nothing.
/// Errors   none.
#pragma once

#include "app/show/import_watch.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/service/journal.h"

#include <cstddef>
#include <functional>

namespace frustumscreen::show {

class ImportJournal {
public:
    static constexpr std::size_t max_lines = 16;
    using Write = std::function<void(service::LogPriority priority, const Sentence& line)>;

    /// Call once a second. An import that was over long before the exhibit began is not logged again. A new import
    /// waits until the previous one's lines have been written.
    void note(const SharedImport& import, const Write& write);

private:
    void note_packs(const Write& write);

    SharedImport noted_;
    std::size_t packs_ = 0; ///< number of the import's packs already logged
};

} // namespace frustumscreen::show

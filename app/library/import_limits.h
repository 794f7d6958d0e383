/// The most that a stick may cost before it is refused.
#pragma once

#include "firmware_host/base/time.h"

#include <cstddef>
#include <cstdint>

namespace frustumscreen::library {

struct ImportLimits {
    Nanoseconds look = std::chrono::seconds(60); ///< wall time until every pack's signature has been checked
    /// Processor time for packs that are refused in the end.
    Nanoseconds refused_work = std::chrono::milliseconds(1500);
    int max_refused_copies = 3;        ///< whatever their work: a damaged pack may be large
    int max_refused_copies_of_one = 2; ///< of the same pack; after that it is not tried again
    /// At least `pace_bytes` must come in each `pace` of reading.
    Nanoseconds pace = std::chrono::seconds(30);
    std::uint64_t pace_bytes = 4U << 20U;
    std::size_t step_bytes = 128U << 10U;    ///< copied at a time; a stick's own read-ahead is as long
    std::uint64_t margin_bytes = 64U << 20U; ///< that stay free on the kiosk's disk
    std::size_t max_entries = 20000;         ///< in all the folders that are walked, together
    std::size_t max_folders = 500;           ///< in the root
    std::size_t max_packs = 1000;
};

} // namespace frustumscreen::library

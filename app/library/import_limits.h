/// What a stick may cost before it is refused.
#pragma once

#include "firmware_host/base/time.h"

#include <cstddef>
#include <cstdint>

namespace frustumscreen {

struct ImportLimits {
    Nanoseconds look = std::chrono::seconds(60); ///< by the clock, until every pack's signature was looked at
    /// Of the processor, for packs that are refused in the end.
    Nanoseconds refused_work = std::chrono::milliseconds(1500);
    int most_refused_copies = 3;        ///< whatever work they are: a pack that is damaged may be large
    int most_refused_copies_of_one = 2; ///< of the same pack: then it is not tried again
    /// So many bytes must come in each such time that reads of the stick take.
    Nanoseconds pace = std::chrono::seconds(30);
    std::uint64_t pace_bytes = 4U << 20U;
    std::size_t step_bytes = 128U << 10U;    ///< copied at a time; a stick reads on by itself as far as that
    std::uint64_t margin_bytes = 64U << 20U; ///< stay free on the kiosk's disk
    std::size_t most_entries = 20000;        ///< in the folders that are looked into, all together
    std::size_t most_folders = 500;          ///< in the root
    std::size_t most_packs = 1000;
};

} // namespace frustumscreen

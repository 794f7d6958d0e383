#include "app/library/import_costs.h"

namespace frustumscreen::library {

bool ReadingPace::add(std::uint64_t bytes, Nanoseconds reading) {
    bytes_ += bytes;
    reading_ += reading;
    if (reading_ <= limits_.pace) {
        return true;
    }
    const bool is_fast_enough = bytes_ >= limits_.pace_bytes;
    bytes_ = 0;
    reading_ = Nanoseconds(0);
    return is_fast_enough;
}

void WastedWorkBudget::add_copy(Nanoseconds work, const std::string& manifest_sha256) {
    work_ += work;
    ++copies_;
    ++copies_of_[manifest_sha256];
}

bool WastedWorkBudget::is_hopeless(const std::string& manifest_sha256) const {
    const auto copies = copies_of_.find(manifest_sha256);
    return copies != copies_of_.end() && copies->second >= limits_.max_refused_copies_of_one;
}

} // namespace frustumscreen::library

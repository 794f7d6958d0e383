#include "app/exhibit/set_change.h"

#include "app/exhibit/selection.h"
#include "app/geometry/time_curves.h"

namespace frustumscreen::exhibit {

void SetChange::step(MonotonicTime now, Moment moment) {
    if (ready_ && !waits_since_) {
        waits_since_ = now; // kept while the other set loads an artifact that was chosen meanwhile
    }
    if (ready_ && !leaves()) {
        const bool waited = now - *waits_since_ >= longest_wait;
        if (moment == Moment::Fits || (moment == Moment::Busy && waited)) {
            leaves_since_ = now;
        }
    }
    left_ = leaves() && now - *leaves_since_ >= fade_time;
}

double SetChange::share(MonotonicTime now) const {
    return leaves_since_ ? 1.0 - geometry::ease(to_seconds(now - *leaves_since_) / to_seconds(fade_time))
                         : 1.0;
}

} // namespace frustumscreen::exhibit

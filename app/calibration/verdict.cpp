#include "app/calibration/verdict.h"

namespace frustumscreen::calibration {

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::Good:
        return "good";
    case Verdict::Usable:
        return "usable";
    case Verdict::Repeat:
        return "repeat";
    case Verdict::Refused:
        break;
    }
    return "refused";
}

} // namespace frustumscreen::calibration

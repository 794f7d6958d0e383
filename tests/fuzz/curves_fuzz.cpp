// Curves: refused in one line, or written again they give the same bytes.
#include "app/pack/curves_part.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

using namespace frustumscreen;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = fuzz::bytes_of(data, size);
    const auto curves = pack::decode_curves(bytes);
    if (!curves) {
        fuzz::require_one_line(curves.error().message);
        return 0;
    }
    std::size_t keys = 0;
    for (const pack::StoredCurve& stored : *curves) {
        const world::Curve& curve = stored.curve;
        keys += curve.times_s.size();
        fuzz::require(!curve.times_s.empty() &&
                          curve.values.size() ==
                              curve.times_s.size() * pack::values_per_key(curve.interpolation),
                      "a curve has a value for each of its keys");
    }
    fuzz::require(curves->size() <= world::max_channels && keys <= world::max_keys,
                  "their numbers are bounded");
    const Bytes written = pack::encode_curves(*curves);
    fuzz::require(std::equal(written.begin(), written.end(), bytes.begin(), bytes.end()),
                  "what was read is written again byte for byte");
    return 0;
}

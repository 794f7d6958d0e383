// A pack's manifest: refused in one line, or written again it reads equal.
#include "app/pack/manifest.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto manifest = pack::parse_manifest(fuzz::text_of(data, size));
    if (!manifest) {
        fuzz::require_one_line(manifest.error().message);
        return 0;
    }
    const std::string written = pack::write_manifest(*manifest);
    const auto again = pack::parse_manifest(written);
    fuzz::require(again.has_value(), "what was written is read", again ? written : again.error().message);
    fuzz::require(pack::write_manifest(*again) == written, "a manifest written again is the same", written);
    return 0;
}

// Names of files that a model refers to: whatever the name, nothing outside the model's folder is looked at.
#include "assets_baked/bake/loaders/refusal.h"
#include "assets_baked/bake/loaders/sidecar.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

/// Looks at a folder that is not there, deep enough that leaving it by name would show in the message.
void check_name(std::string_view name) {
    const std::string folder = "nowhere/at/all";
    Sidecars sidecars(folder);
    try {
        static_cast<void>(sidecars.exists(name, "images[0]"));
        static_cast<void>(sidecars.read(name, "images[0]"));
        fuzz::require(false, "nothing is read where nothing is");
    } catch (const Refusal& refusal) {
        fuzz::require(refusal.message.starts_with("images[0]: "), "a refusal says where", refusal.message);
        fuzz::require(refusal.message.starts_with("images[0]: \"") ||
                          refusal.message.starts_with("images[0]: the file name is ") ||
                          refusal.message.starts_with("images[0]: " + folder),
                      "only the model's folder is looked at", refusal.message);
    }
}

std::string encoded(std::string_view plain) {
    static constexpr std::string_view digits = "0123456789ABCDEF";
    std::string uri;
    for (const char c : plain) {
        const auto code = static_cast<unsigned char>(c);
        uri += {'%', digits[code >> 4U], digits[code & 15U]};
    }
    return uri;
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    check_name(text);
    fuzz::require(percent_decoded(encoded(text), "uri") == text, "what is encoded is decoded");
    try {
        const std::string plain = percent_decoded(text, "uri");
        fuzz::require(plain.size() <= text.size(), "decoding adds nothing");
        check_name(plain);
    } catch (const Refusal& refusal) {
        fuzz::require(refusal.message.starts_with("uri: "), "a refusal says where", refusal.message);
    }
    return 0;
}

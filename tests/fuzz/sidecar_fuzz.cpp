// Names of files that a model refers to: no name leads to access outside the model's folder.
#include "assets_baked/bake/loaders/refusal.h"
#include "assets_baked/bake/loaders/sidecar.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

/// Uses a folder that does not exist.
void check_name(std::string_view name) {
    const std::string folder = "nowhere/at/all";
    bake::LoadNotes notes;
    bake::Sidecars sidecars(folder, notes);
    try {
        fuzz::require(!sidecars.exists(name) && !sidecars.like(name), "nothing is where nothing is", name);
        sidecars.mention(name);
        fuzz::require(sidecars.files().empty(), "nothing is read where nothing is", name);
        static_cast<void>(sidecars.read(name, "images[0]"));
        fuzz::require(false, "nothing is read where nothing is");
    } catch (const bake::Refusal& refusal) {
        fuzz::require(refusal.error.message.ends_with(" (images[0])"), "a refusal says where",
                      refusal.error.message);
        fuzz::require_one_line(refusal.error.message);
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
    fuzz::require(bake::percent_decoded(encoded(text), "uri") == text, "what is encoded is decoded");
    try {
        const std::string plain = bake::percent_decoded(text, "uri");
        fuzz::require(plain.size() <= text.size(), "decoding adds nothing");
        check_name(plain);
    } catch (const bake::Refusal& refusal) {
        fuzz::require(refusal.error.message.find("(uri: ") != std::string::npos, "a refusal says where",
                      refusal.error.message);
    }
    return 0;
}

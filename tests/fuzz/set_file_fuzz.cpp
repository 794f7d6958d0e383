// set.txt with a valid hash, and the exhibit's verdict: refused in one line, or written again they read
// equal. All named files are inside the folder.
#include "app/library/set_file.h"
#include "app/pack/container/sha256.h"
#include "tests/fuzz/fuzz.h"

#include <fmt/format.h>

using namespace frustumscreen;

namespace {

void require_inside(const library::InstalledSet& set) {
    for (const library::InstalledPack& pack : set.packs) {
        fuzz::require(pack.file == "packs/" + pack.sha256 + ".fspack" && library::is_sha256_text(pack.sha256),
                      "a pack is named by its hash", pack.file);
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view body = fuzz::text_of(data, size);
    const auto hash = pack::sha256_hex(fuzz::bytes_of(data, size));
    const auto file = library::parse_set_file(fmt::format("frustumscreen-set 1 {}\n{}", hash, body));
    if (file) {
        require_inside(file->choice.set);
        require_inside(file->choice.last_good.value_or(library::InstalledSet()));
        require_inside(file->before.value_or(library::InstalledSet()));
        const auto again = library::parse_set_file(library::write_set_file(*file));
        fuzz::require(again && *again == *file, "written again it reads the same");
    } else {
        fuzz::require_one_line(file.error().message);
    }
    fuzz::require(!library::parse_set_file(body) || body.starts_with("frustumscreen-set 1 "),
                  "its hash stands first");
    if (const auto verdict = library::parse_verdict(body)) {
        const auto again = library::parse_verdict(library::write_verdict(*verdict));
        fuzz::require(again && *again == *verdict, "a verdict written again reads the same");
    } else {
        fuzz::require_one_line(verdict.error().message);
    }
    return 0;
}

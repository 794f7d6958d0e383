// A stick's exhibit.toml: it is either refused in one line that begins with the file's name, or contains only
// what a set may contain.
#include "app/library/exhibit_file.h"
#include "app/pack/pack_text.h"
#include "app/pack/signature/signature.h"
#include "firmware_host/base/calendar_day.h"
#include "tests/fuzz/fuzz.h"

#include <set>

using namespace frustumscreen;

namespace {

void require_ids(const std::vector<std::string>& ids) {
    std::set<std::string> seen;
    for (const std::string& id : ids) {
        fuzz::require(pack::is_artifact_id(id) && seen.insert(id).second, "ids are ids, each once", id);
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = library::parse_exhibit_file(fuzz::text_of(data, size));
    if (!file) {
        fuzz::require(file.error().message.starts_with("exhibit.toml:"), "a message names the file",
                      file.error().message);
        fuzz::require_one_line(file.error().message);
        return 0;
    }
    require_ids(file->order);
    require_ids(file->remove);
    fuzz::require(!file->only || !file->order.empty(), "something is left");
    for (const library::AttractText& text : file->attract.value_or(std::vector<library::AttractText>())) {
        fuzz::require(pack::has_language_form(text.language), "a language has its form", text.language);
        fuzz::require(!text.text.empty() && !pack::fault_of_text(text.text, pack::TextShape::Line),
                      "a text is clean", text.text);
    }
    for (const library::CarriedKey& key : file->keys) {
        fuzz::require(pack::parse_public_key(key.public_key).has_value(), "a key is one", key.public_key);
        fuzz::require(key.until.empty() || parse_day(key.until), "a day is one", key.until);
        fuzz::require(!key.name.empty(), "a key has a name");
    }
    return 0;
}

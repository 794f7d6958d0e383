#include "app/pack/pack_sections.h"

#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"
#include "app/pack/pack_reader.h"
#include "app/pack/picture_part.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::pack {

namespace {

/// Opens the file and calls `work` on it; messages get the file's name.
template <typename Value>
Result<Value> with_pack(const std::filesystem::path& file,
                        const std::function<Result<Value>(PackReader&)>& work) {
    TRY(PackReader reader, open_pack_file(file));
    const PackDescription& description = reader.manifest().description;
    const Result<void> good = check_description(description);
    return at(file.string(), good ? work(reader) : tl::unexpected(good.error()));
}

Result<PackCard> read_card(PackReader& reader) {
    const PackDescription& pack = reader.manifest().description;
    PackCard card{
        .id = pack.id, .title = pack.title, .languages = pack.languages, .titles = {}, .table_picture = {}};
    for (const PackCaption& caption : pack.captions) {
        card.titles.push_back({caption.language, caption.title});
    }
    TRY(card.table_picture, read_table_picture(reader));
    return card;
}

bool has_part(const PackDescription& pack, const std::string& name) {
    return std::any_of(pack.sections.begin(), pack.sections.end(), [&](const PackSection& section) {
        return std::find(section.parts.begin(), section.parts.end(), name) != section.parts.end();
    });
}

Result<std::map<std::string, Bytes>> read_parts(PackReader& reader, const ChooseParts& choose) {
    TRY(const std::vector<std::string> names, choose(reader.manifest().description));
    std::map<std::string, Bytes> parts;
    for (const std::string& name : names) {
        if (!has_part(reader.manifest().description, name)) {
            return bad_input("pack.no_such_part", "no section has the part '{}'", printable(name, 40));
        }
        TRY(Bytes bytes, reader.take(name));
        parts.emplace(name, std::move(bytes));
    }
    return parts;
}

} // namespace

Result<PackCard> load_pack_card(const std::filesystem::path& file) {
    return with_pack<PackCard>(file, read_card);
}

Result<std::map<std::string, Bytes>> load_section_parts(const std::filesystem::path& file,
                                                        const ChooseParts& choose) {
    return with_pack<std::map<std::string, Bytes>>(
        file, [&](PackReader& reader) { return read_parts(reader, choose); });
}

} // namespace frustumscreen::pack

#include "app/library/stick_look.h"

#include "app/library/copy_pack.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen::library {

ImportResult<void> StickLook::run(StickContents& contents, const SetFile& known) {
    TRY(contents.files, walk_stick(stick_, limits_, [this] { return is_too_late(); }));
    if (contents.files.has_exhibit_file) {
        TRY_VOID(read_exhibit_file(contents, known));
    }
    return look_at_packs(contents.packs, contents.files.packs);
}

ImportResult<void> StickLook::read_exhibit_file(StickContents& contents, const SetFile& known) {
    contents.exhibit_line.emplace().file = exhibit_file_name;
    ImportResult<SignedExhibitFile> read = read_signed_exhibit_file(stick_, keys_.trust(), known);
    if (read && read->signer) {
        if (const Result<void> brought = keys_.bring(read->file.keys, *read->signer); !brought) {
            read = failed({.refusal = ImportRefusal::WrongKey,
                           .reason = fmt::format("{}: {}", exhibit_file_name, brought.error().message),
                           .whole = true});
        }
    }
    if (!read) {
        refuse(*contents.exhibit_line, read.error());
        return failed(read.error());
    }
    contents.exhibit = *std::move(read);
    return {};
}

ImportResult<void> StickLook::look_at_packs(std::vector<StickPack>& packs,
                                            const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
        const Nanoseconds before = outside_.work();
        ImportResult<StickPack> pack = look_at_pack(stick_, path, keys_.trust());
        if (is_too_late()) {
            return failed(too_slow());
        }
        if (pack) {
            packs.push_back(*std::move(pack));
            continue;
        }
        StickPack& refused = packs.emplace_back();
        refused.path = path;
        refused.told.file = printable(path);
        if (pack.error().whole) {
            return failed(pack.error());
        }
        refuse(refused.told, pack.error());
        in_vain_.add_look(outside_.work() - before);
        if (in_vain_.is_too_much()) {
            return failed(too_much(
                "the stick holds many files that look like packs and are not packs; put only packs on it"));
        }
    }
    return {};
}

} // namespace frustumscreen::library

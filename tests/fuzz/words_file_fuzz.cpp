// Files of the exhibit's own words: refused in one line, or every word can be typeset, and written again they
// read equal.
//
// An input is used as a file, and as a manifest with the parts of a small file: otherwise hashes would hide
// the code behind them from nearly every input.
#include "app/pack/container/zip_archive.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/words_file.h"

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

bool equal(const pack::LanguageWords& a, const pack::LanguageWords& b) {
    return a.language == b.language && a.name == b.name && a.words == b.words && a.runs == b.runs &&
           a.atlas.texels == b.atlas.texels && a.sounds == b.sounds;
}

void check_language(std::span<const std::byte> file, const std::string& language) {
    const Result<pack::LanguageWords> words = pack::read_words(file, language);
    if (!words) {
        fuzz::require_one_line(words.error().message);
        return;
    }
    for (const pack::PlainWord& word : words->words) {
        fuzz::require(words->runs.find(word.key) != nullptr, "a word can be set", word.key);
    }
    const Result<Bytes> written = pack::write_words(std::span(&*words, 1));
    const Result<pack::LanguageWords> again = pack::read_words(written.value_or(Bytes()), language);
    fuzz::require(again && equal(*again, *words), "what was read is written and read again as it was");
}

void check(std::span<const std::byte> file) {
    const Result<std::vector<pack::WordsLanguage>> languages = pack::list_words(file);
    if (!languages) {
        fuzz::require_one_line(languages.error().message);
        return;
    }
    for (const pack::WordsLanguage& each : *languages) {
        check_language(file, each.language);
    }
}

/// The parts of a small file with this manifest.
Bytes with_manifest(std::span<const std::byte> manifest) {
    static const Bytes small = fuzz::small_words_file();
    ZipWriter made;
    made.add("manifest.json", manifest, Packing::Stored);
    Result<ZipReader> parts = ZipReader::open(small);
    for (const std::string name : {"de/glyphs.bin", "de/atlas.webp", "de/help.opus"}) {
        const ZipEntry* const entry = parts ? parts->find(name) : nullptr;
        fuzz::require(entry != nullptr, "the small file has its parts", name);
        made.add(name, *parts->read(*entry), Packing::Stored);
    }
    return made.finish().value_or(Bytes());
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes = fuzz::bytes_of(data, size);
    check(bytes);
    check(with_manifest(bytes));
    return 0;
}

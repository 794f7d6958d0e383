#include "app/programs/batch/run_batch.h"

#include "app/programs/batch/child_sentence.h"
#include "app/programs/batch/content_hash.h"
#include "firmware_host/base/time.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <system_error>
#include <thread>

namespace frustumscreen::programs {

namespace {

namespace fs = std::filesystem;

/// An object's files.
struct Outputs {
    fs::path pack, stamp, page;
};

Outputs outputs_of(const BatchPlan& plan, const BatchObject& object) {
    const auto named = [&](const char* ending) { return plan.output / (object.name + ending); };
    return {named(".fspack"), named(".stamp"), named(".html")};
}

BatchRow failed(const BatchObject& object, std::string sentence) {
    BatchRow row;
    row.object = object.name;
    row.status = BatchStatus::Failed;
    row.sentence = std::move(sentence);
    return row;
}

Result<std::string> key_of(const BatchPlan& plan, const BatchObject& object) {
    TRY(const std::string content, hash_of_object(object.input));
    std::vector<std::string> texts{content, plan.program_key, plan.pages ? "pages" : ""};
    texts.insert(texts.end(), plan.bake_options.begin(), plan.bake_options.end());
    return hash_of_texts(texts);
}

/// True if the stamp's pack exists, byte for byte.
bool is_done(const std::optional<Stamp>& stamp, const std::string& key, const Outputs& outputs) {
    if (!stamp || stamp->key != key || stamp->pack_sha256.empty()) {
        return false;
    }
    std::error_code none;
    const Result<std::string> pack = hash_of_file(outputs.pack);
    return pack && *pack == stamp->pack_sha256 && (!stamp->row.has_page || fs::exists(outputs.page, none));
}

BatchRow bake(const BatchPlan& plan, const BatchObject& object, const Outputs& outputs) {
    std::vector<std::string> command = plan.program;
    command.insert(command.end(), {object.input.string(), "--output=" + outputs.pack.string(), "--json"});
    if (plan.pages) {
        command.push_back("--preview=" + outputs.page.string());
    }
    command.insert(command.end(), plan.bake_options.begin(), plan.bake_options.end());
    const MonotonicTime start = monotonic_now();
    const Result<ProgramEnd> end = follow_program(command, "", plan.limits);
    if (!end) {
        return failed(object, end.error().message);
    }
    BatchRow row;
    row.object = object.name;
    row.status = BatchStatus::Baked;
    row.sentence = sentence_of(*end, plan.limits);
    if (row.sentence.empty() && !take_bake_report(as_text(end->output), row)) {
        row.sentence = "the bake gave no report; keep the scan and report it";
    }
    row.status = row.sentence.empty() ? BatchStatus::Baked : BatchStatus::Failed;
    row.seconds = to_seconds(monotonic_now() - start);
    return row;
}

/// Adds a note if an old pack remains, so it is not mistaken for the result of this bake. `before`: the
/// pack's hash before the bake, if it existed.
std::string with_old_pack(std::string sentence, const Outputs& outputs, const Result<std::string>& before) {
    const Result<std::string> now = hash_of_file(outputs.pack);
    return before && now && *before == *now ? std::move(sentence) + " (the previous pack is still there)"
                                            : sentence;
}

BatchRow bake_and_stamp(const BatchPlan& plan, const BatchObject& object, const Outputs& outputs,
                        const std::string& key) {
    std::error_code none;
    fs::remove(outputs.stamp, none);
    const Result<std::string> before = hash_of_file(outputs.pack);
    Stamp stamp{key, {}, bake(plan, object, outputs)};
    if (stamp.row.status == BatchStatus::Baked) {
        const Result<std::string> hash = hash_of_file(outputs.pack);
        if (!hash) {
            return failed(object, hash.error().message);
        }
        stamp.pack_sha256 = *hash;
    } else {
        stamp.row.sentence = with_old_pack(std::move(stamp.row.sentence), outputs, before);
    }
    if (const Result<void> written = write_stamp(outputs.stamp, stamp); !written) {
        return failed(object, written.error().message);
    }
    return stamp.row;
}

BatchRow row_of(const BatchPlan& plan, const BatchObject& object) {
    if (!object.fault.empty()) {
        return failed(object, object.fault);
    }
    const Outputs outputs = outputs_of(plan, object);
    const Result<std::string> key = key_of(plan, object);
    if (!key) {
        return failed(object, key.error().message);
    }
    const std::optional<Stamp> stamp = read_stamp(outputs.stamp);
    if (is_done(stamp, *key, outputs)) {
        return stamp->row;
    }
    if (plan.bakes) {
        return bake_and_stamp(plan, object, outputs, *key);
    }
    if (stamp && stamp->key == *key && stamp->pack_sha256.empty()) {
        return stamp->row;
    }
    BatchRow missing;
    missing.object = object.name;
    missing.sentence = "it is not baked yet, or has changed since; run the batch without --report-only";
    return missing;
}

} // namespace

std::vector<BatchRow> run_batch(const BatchPlan& plan, const std::function<void(const BatchRow&)>& tell) {
    std::vector<BatchRow> rows(plan.objects.size());
    std::atomic<std::size_t> next{0};
    std::mutex narration_sequencer;
    const auto work = [&] {
        for (std::size_t k = next++; k < rows.size(); k = next++) {
            rows[k] = row_of(plan, plan.objects[k]);
            const std::scoped_lock lock(narration_sequencer);
            tell(rows[k]);
        }
    };
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < std::min(plan.jobs, rows.size()); ++k) {
        threads.emplace_back(work);
    }
    threads.clear();
    return rows;
}

} // namespace frustumscreen::programs

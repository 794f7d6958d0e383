#include "app/status/status_document.h"

#include "app/status/exhibit_verdict.h"
#include "app/status/watchdog_status.h"

#include <cmath>

namespace frustumscreen::status {

namespace {

using Json = nlohmann::ordered_json;

Json rounded_or_null(const std::optional<double>& number) {
    return number ? Json(std::round(*number * 1000.0) / 1000.0) : Json(nullptr);
}

Json json_of(const StatusDocument& document) {
    return {{"age_s", rounded_or_null(document.age_s)},
            {"why_unknown", document.why},
            {"status", Json(document.fields)}};
}

Json json_of_watchdog(const StatusDocument& document) {
    Json json = json_of(document);
    json["id"] = watchdog_id(document);
    return json;
}

Json json_of_machine(const Environment& environment) {
    const MachineState& machine = environment.machine;
    return {{"on_s", rounded_or_null(environment.monotonic_s)},
            {"hottest_c", rounded_or_null(machine.hottest_c)},
            {"disk", machine.disk ? Json{{"free_bytes", machine.disk->free_bytes},
                                         {"size_bytes", machine.disk->size_bytes},
                                         {"writable", machine.disk->writable}}
                                  : Json(nullptr)}};
}

Json json_of(const Environment& environment) {
    const watch::ServiceEnds& ends = environment.ends;
    Json last = nullptr;
    if (ends.last) {
        last = {{"ago_s", rounded_or_null(environment.monotonic_s - ends.last->monotonic_s)},
                {"result", watch::service_results.at(ends.last->result).word},
                {"code", ends.last->code},
                {"exit_status", ends.last->exit_status}};
    }
    return {{"count", ends.count()}, {"last", last}, {"why_unknown", environment.ends_trouble}};
}

Json json_of(const std::vector<watch::Crash>& crashes) {
    Json all = Json::array();
    for (const watch::Crash& crash : crashes) {
        all.push_back({{"unix_s", crash.unix_s},
                       {"sentence", watch::sentence_of(crash)},
                       {"signal", crash.signal},
                       {"thread", crash.thread},
                       {"program", crash.program},
                       {"system", crash.system},
                       {"driver", crash.driver},
                       {"frames", crash.frames},
                       {"guesses", crash.guesses},
                       {"whole", crash.whole}});
    }
    return all;
}

Json json_of(const SystemImage& image) {
    return image.there() ? Json{{"version", image.version}, {"slot", image.slot}, {"notes", image.notes}}
                         : Json(nullptr);
}

} // namespace

std::string status_document(const KnownExhibit& known) {
    const ExhibitVerdict verdict = verdict_of(known);
    const Json document = {{"well", verdict.well},
                           {"runs", verdict.runs},
                           {"sentence", verdict.sentence},
                           {"id", verdict.id},
                           {"age_s", rounded_or_null(known.status.age_s)},
                           {"exhibit", json_of(known.status)},
                           {"watchdog", json_of_watchdog(known.environment.watchdog)},
                           {"ends", json_of(known.environment)},
                           {"crashes", json_of(known.environment.crashes)},
                           {"system", json_of(known.environment.image)},
                           {"machine", json_of_machine(known.environment)}};
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace frustumscreen::status

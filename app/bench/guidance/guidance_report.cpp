#include "app/bench/guidance/guidance_report.h"

#include "app/bench/truth/seeded_situations.h"
#include "firmware_host/base/time.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::bench {

namespace {

constexpr std::size_t max_moves = 12;
constexpr double max_p95_s = 6.0;
constexpr double min_whole = 0.95;

double quantile(const std::vector<double>& ascending, double share) {
    if (ascending.empty()) {
        return 0.0;
    }
    const double place = share * static_cast<double>(ascending.size() - 1);
    return ascending[static_cast<std::size_t>(std::lround(place))];
}

AdviceProof prove(const guidance::GuidanceSetup& setup, const GuidanceOptions& options,
                  const std::function<void(double)>& progress) {
    AdviceProof proof;
    proof.situations = options.situations;
    proof.restored_after.assign(max_moves, 0);
    Seeded seeded(options.seed);
    std::vector<double> times_ms;
    for (int k = 0; k < options.situations; ++k) {
        if (k % 256 == 0) {
            progress(static_cast<double>(k) / options.situations);
        }
        guidance::GuidedState tracked_state = seeded_situation(setup, seeded);
        guidance::Advisor advisor(setup);
        const guidance::FaceReader& reader = advisor.reader();
        const auto whole = [&](const guidance::GuidedState& now) {
            return reader.shows_whole(now, reader.read(now));
        };
        std::size_t moves = 0;
        for (; !whole(tracked_state) && moves < max_moves; ++moves) {
            if (reader.whole(
                    tracked_state)) { // no face of the artifact is seen: Guide advises standing it up
                tracked_state = guidance::after({guidance::Action::Upright}, setup, tracked_state);
                continue;
            }
            const MonotonicTime begun = monotonic_now();
            const guidance::Advice advice = advisor.advise(tracked_state).value_or(guidance::Advice{});
            times_ms.push_back(1e3 * to_seconds(monotonic_now() - begun));
            if (advice.move.action == guidance::Action::Wait) {
                proof.without_advice += moves == 0 ? 1 : 0;
                moves = max_moves;
                break;
            }
            const guidance::GuidedState next =
                guidance::after(advice.move, setup, tracked_state, seeded_person(advice.move, setup, seeded));
            if (advice.steps == 1) {
                ++proof.single;
                const bool helped =
                    reader.whole(next) || reader.lost_px(next) < reader.lost_px(tracked_state);
                proof.failed += helped ? 0 : 1;
            }
            tracked_state = next;
        }
        if (!whole(tracked_state)) {
            ++proof.never;
        } else if (moves == 0) {
            ++proof.valid;
        } else {
            ++proof.restored_after[moves - 1];
        }
    }
    std::sort(times_ms.begin(), times_ms.end());
    proof.median_ms = quantile(times_ms, 0.5);
    proof.p99_ms = quantile(times_ms, 0.99);
    return proof;
}

VisitsOf visits(const guidance::GuidanceSetup& setup, Adviser adviser, const GuidanceOptions& options,
                const std::function<void(double)>& progress) {
    VisitsOf all;
    all.adviser = adviser;
    for (int k = 0; k < options.visitors; ++k) {
        progress(static_cast<double>(k) / options.visitors);
        const VisitResult one =
            simulate_visit(setup, adviser, options.seed + static_cast<std::uint64_t>(k), options.seconds);
        all.restored_s.insert(all.restored_s.end(), one.restored_s.begin(), one.restored_s.end());
        all.whole_share += one.whole_share / options.visitors;
        all.advices_a_minute += 60.0 * one.advices / one.seconds / options.visitors;
        all.losses_a_minute += 60.0 * one.losses / one.seconds / options.visitors;
        for (std::size_t what = 0; what < dark_while_count; ++what) {
            all.dark_share.at(what) += one.dark_s.at(what) / one.seconds / options.visitors;
        }
    }
    std::sort(all.restored_s.begin(), all.restored_s.end());
    return all;
}

double percent(double part, double whole) {
    return whole > 0.0 ? 100.0 * part / whole : 0.0;
}

} // namespace

double VisitsOf::quantile_s(double share) const {
    return quantile(restored_s, share);
}

GuidedProp measure_guidance(const std::string& name, const guidance::GuidanceSetup& setup,
                            const GuidanceOptions& options, const std::function<void(double)>& progress) {
    constexpr double proof_share = 0.5;
    GuidedProp prop{name, prove(setup, options, [&](double done) { progress(proof_share * done); }), {}};
    constexpr std::array advisers{Adviser::Exhibit, Adviser::Paper, Adviser::None, Adviser::Perfect};
    for (std::size_t k = 0; k < advisers.size(); ++k) {
        prop.visits.push_back(visits(setup, advisers.at(k), options, [&](double done) {
            progress(proof_share + (1.0 - proof_share) * (static_cast<double>(k) + done) / advisers.size());
        }));
    }
    return prop;
}

std::string guidance_table(const GuidedProp& prop) {
    const AdviceProof& proof = prop.proof;
    const auto share = [&](int count) { return percent(count, proof.situations); };
    int later = 0;
    for (std::size_t k = 3; k < proof.restored_after.size(); ++k) {
        later += proof.restored_after[k];
    }
    std::string text = fmt::format(
        "{}: {} situations; people follow the advice with errors of up to 20 degrees and 40 % of the amount\n"
        "  whole at the start {:.2f} %, after one move {:.2f} %, two {:.2f} %, three {:.2f} %, more {:.2f} "
        "%, "
        "never {:.3f} %"
        " ({} without any advice)\n"
        "  advice of one move: {} cases, {} without improvement; time to find advice: median {:.2f} ms, 99th "
        "percentile {:.2f} ms\n",
        prop.name, proof.situations, share(proof.valid), share(proof.restored_after[0]),
        share(proof.restored_after[1]), share(proof.restored_after[2]), share(later), share(proof.never),
        proof.without_advice, proof.single, proof.failed, proof.median_ms, proof.p99_ms);
    text += fmt::format("  {:<28} {:>16} {:>16} {:>12} {:>18} {:>17}\n", "simulated visitors",
                        "whole in, median", "95th percentile", "whole", "advice a minute", "losses a minute");
    for (const VisitsOf& visits : prop.visits) {
        text += fmt::format("  {:<28} {:>14.1f} s {:>14.1f} s {:>10.1f} % {:>18.1f} {:>17.1f}\n",
                            name_of(visits.adviser), visits.quantile_s(0.5), visits.quantile_s(0.95),
                            100.0 * visits.whole_share, visits.advices_a_minute, visits.losses_a_minute);
    }
    text += "  share of the time in which the artifact is not whole and the visitor\n";
    text += fmt::format("  {:<28} {:>9} {:>17} {:>13} {:>9} {:>15} {:>8}\n", "", "plays on",
                        "waits for a sign", "overlooks it", "reacts", "moves wrongly", "corrects");
    for (const VisitsOf& visits : prop.visits) {
        const auto& dark = visits.dark_share;
        text += fmt::format("  {:<28} {:>7.1f} % {:>15.1f} % {:>11.1f} % {:>7.1f} % {:>13.1f} % {:>6.1f} %\n",
                            name_of(visits.adviser), 100.0 * dark[0], 100.0 * dark[1], 100.0 * dark[2],
                            100.0 * dark[3], 100.0 * dark[4], 100.0 * dark[5]);
    }
    return text;
}

std::string guidance_csv(const std::vector<GuidedProp>& props) {
    std::string csv = "prop,adviser,quantile,mended_s,whole_share,advices_a_minute\n";
    for (const GuidedProp& prop : props) {
        for (const VisitsOf& visits : prop.visits) {
            for (int k = 1; k < 100; ++k) {
                csv += fmt::format("{},{},{:.2f},{:.3f},{:.4f},{:.2f}\n", prop.name, name_of(visits.adviser),
                                   0.01 * k, visits.quantile_s(0.01 * k), visits.whole_share,
                                   visits.advices_a_minute);
            }
        }
    }
    return csv;
}

std::vector<LimitVerdict> judge(const GuidedProp& prop) {
    const VisitsOf& ours = prop.visits[0];
    const VisitsOf& paper = prop.visits[1];
    const double p95_s = ours.quantile_s(0.95);
    return {
        {prop.name + ": advice of one move always improves, with all errors of following it",
         fmt::format("{} of {} do not", prop.proof.failed, prop.proof.single), prop.proof.failed == 0},
        {prop.name + ": every situation becomes whole",
         fmt::format("{} of {} are not within {} moves", prop.proof.never, prop.proof.situations, max_moves),
         prop.proof.never == 0},
        {fmt::format("{}: 95 % of the losses end within {:g} s", prop.name, max_p95_s),
         fmt::format("{:.1f} s", p95_s), p95_s <= max_p95_s},
        {fmt::format("{}: whole for {:g} % of the time", prop.name, 100.0 * min_whole),
         fmt::format("{:.1f} %", 100.0 * ours.whole_share), ours.whole_share >= min_whole},
        {prop.name + ": better than the paper's rule",
         fmt::format("95th percentile {:.1f} s against {:.1f} s, whole {:.1f} % against {:.1f} %", p95_s,
                     paper.quantile_s(0.95), 100.0 * ours.whole_share, 100.0 * paper.whole_share),
         p95_s < paper.quantile_s(0.95) && ours.whole_share > paper.whole_share}};
}

} // namespace frustumscreen::bench

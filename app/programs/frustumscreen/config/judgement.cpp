#include "app/programs/frustumscreen/config/judgement.h"

#include "app/exhibit/languages.h"
#include "app/pack/words_file.h"
#include "app/programs/frustumscreen/config/named_packs.h"
#include "app/programs/frustumscreen/config/week_page.h"
#include "app/settings/focus_range.h"
#include "app/settings/stereo_parallax.h"
#include "app/settings/whole_zone.h"
#include "app/typography/captions.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/local_time.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

namespace frustumscreen::programs {

namespace {

/// Pixels an em below which small letters lose their shape.
constexpr double min_em_px = 18.0;
/// ISO 9241-303: capitals need 16 minutes of arc to be read.
constexpr double min_capital_arcmin = 16.0;
constexpr double capital_em = 0.714; ///< height of Noto Sans's capitals
/// Share of places with space for a caption below which most visitors read none.
constexpr double min_caption_share = 0.5;
/// Half the size of a zone to play in: a hand slides the prop 10 to 30 cm to look at it.
constexpr glm::dvec2 min_zone_m(0.20, 0.10);

struct Page {
    std::string text;                ///< findings
    std::vector<std::string> faults; ///< findings that need attention
};

double em_m(const settings::Settings& settings) {
    return std::max(settings.exhibit.caption_height_m, typography::min_caption_em_m);
}

/// Minutes of arc of a capital at an em of one metre, flat on the table's middle, seen from the default eye.
double arcmin_per_em_m(const settings::EyeSettings& eye) {
    const double distance = glm::length(eye.default_m);
    const double foreshortened = eye.default_m.z / distance;
    return 60.0 * glm::degrees(capital_em * foreshortened / distance);
}

/// Rounds up to whole millimetres.
double rounded_up(double metres) {
    constexpr double rounding = 1e-9;
    return std::ceil(1e3 * metres - rounding) / 1e3;
}

void judge_letters(const settings::Settings& settings, Page& page) {
    if (!settings.exhibit.captions) {
        page.text += "  Captions are left out.\n";
        return;
    }
    const settings::ProjectorSettings& projector = settings.projector;
    const double px_per_m = std::min(projector.pinhole.fx, projector.pinhole.fy) /
                            glm::length(projector.table_from_projector.translation);
    const double em = em_m(settings);
    const double px = em * px_per_m;
    const double arcmin = em * arcmin_per_em_m(settings.eye);
    page.text += fmt::format("  Letters are set {:.3g} mm high, {:.0f} pixels. For eyes at eye.default_m a "
                             "capital is {:.0f} minutes of arc high.\n",
                             1e3 * em, px, arcmin);
    if (px < min_em_px) {
        page.faults.push_back(
            fmt::format("A caption's letters are {:.0f} pixels high, too few to read: they need {:g}. Hang "
                        "the projector nearer, "
                        "take one with more pixels, or set exhibit.caption_height_m = {:.3f}.",
                        px, min_em_px, rounded_up(min_em_px / px_per_m)));
    }
    if (arcmin < min_capital_arcmin) {
        page.faults.push_back(fmt::format(
            "A caption is too small for eyes at eye.default_m: a capital is {:.0f} minutes of arc high, and "
            "needs {:g} (ISO 9241-303). Set exhibit.caption_height_m = {:.3f}.",
            arcmin, min_capital_arcmin, rounded_up(min_capital_arcmin / arcmin_per_em_m(settings.eye))));
    }
}

void judge_caption_room(const settings::Settings& settings, const std::vector<NamedPack>& packs,
                        const settings::Rectangle& zone, Page& page) {
    if (!settings.exhibit.captions || packs.empty() || settings.prop.zone == settings::PropZone::Hand ||
        packs.front().entry.languages.empty()) {
        return;
    }
    const double share = caption_share(settings, packs, zone);
    page.text += fmt::format("  The caption of \"{}\" finds room at {:.0f} % of the places of the zone.\n",
                             packs.front().description.title, 100.0 * share);
    if (share < min_caption_share) {
        page.faults.push_back(fmt::format("A caption finds room at {:.0f} % of the places of the zone: "
                                          "elsewhere none is shown. Shorten the texts, set "
                                          "a smaller exhibit.caption_height_m, or leave the pictures on the "
                                          "table out (exhibit.table_pictures).",
                                          100.0 * share));
    }
}

std::string size_words(const settings::Rectangle& zone) {
    return fmt::format("{:.0f} x {:.0f} cm", 200.0 * zone.half_m.x, 200.0 * zone.half_m.y);
}

bool is_narrow(const settings::Rectangle& zone) {
    return 2.0 * zone.half_m.x < min_zone_m.x || 2.0 * zone.half_m.y < min_zone_m.y;
}

/// Suggests the wider zoom of the lens at which the zone is wide enough to play in.
std::string wider_picture(settings::Settings settings, const std::vector<glm::dvec3>& hull) {
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    for (int step = 0; step < 12; ++step) {
        constexpr double wider = 0.95;
        settings.projector.pinhole.fx *= wider;
        settings.projector.pinhole.fy *= wider;
        const settings::Rectangle zone =
            settings::whole_zone(settings, settings::all_eyes(settings.eye), hull).rectangle;
        if (!is_narrow(zone)) {
            return fmt::format("With a throw ratio of {:.2f} in place of {:.2f} it is {}",
                               pinhole.fx / pinhole.width,
                               pinhole.fx / pinhole.width / std::pow(wider, step + 1), size_words(zone));
        }
    }
    return "Hang the projector higher, take a larger table or a smaller prop";
}

/// Returns the zone of the first artifact; without packs, that of a typical artifact.
settings::Rectangle judge_zone(const settings::Settings& settings, const std::vector<NamedPack>& packs,
                               Page& page) {
    std::optional<settings::Rectangle> first;
    const auto judge = [&](const std::string& name, const std::vector<glm::dvec3>& hull) {
        const settings::Rectangle zone =
            settings::whole_zone(settings, settings::all_eyes(settings.eye), hull).rectangle;
        first = first.value_or(zone);
        page.text += fmt::format(
            "  {} is seen whole from all around while the prop is within {}; by eyes as high as "
            "eye.default_m, within {}.\n",
            name, size_words(zone),
            size_words(
                settings::whole_zone(settings, settings::eyes_like_default(settings.eye), hull).rectangle));
        if (is_narrow(zone)) {
            page.faults.push_back(
                fmt::format("The zone is too narrow to play in: {} is seen whole within {}, and {:.0f} x "
                            "{:.0f} cm are needed. {}.",
                            name, size_words(zone), 100.0 * min_zone_m.x, 100.0 * min_zone_m.y,
                            wider_picture(settings, hull)));
        }
    };
    if (settings.prop.zone == settings::PropZone::Hand) {
        return settings::whole_zone(settings, settings::all_eyes(settings.eye), {})
            .rectangle; // setup_page prints it
    }
    for (const NamedPack& pack : packs) {
        judge("\"" + pack.description.title + "\"", pack.hull);
    }
    if (packs.empty()) {
        const std::vector<glm::dvec3> usual = settings::usual_artifact(settings::make_prop(settings.prop));
        judge(fmt::format("An artifact {:.0f} mm high and {:.0f} mm wide", 1e3 * settings.prop.height_m,
                          650.0 * settings.prop.height_m),
              usual);
    }
    return *first;
}

/// Why the parallax for the nearest eyes is too large, and what makes it smaller.
std::string parallax_fault(const settings::Settings& settings, double parallax_rad) {
    const settings::EyeSettings& eye = settings.eye;
    const std::optional<double> comfortable_m = settings::comfortable_distance_m(settings);
    return fmt::format("Stereo tires eyes near the prop: the parallax is up to {:.2f} degrees at "
                       "eye.nearest_m, {:g} m, and comfortable is 1 degree. {}Artifacts that fill less of "
                       "the prop have less parallax; eye.interocular_mm = {:.0f} makes it comfortable.",
                       glm::degrees(parallax_rad), eye.nearest_m,
                       comfortable_m ? fmt::format("Keep visitors' eyes {:.2f} m away, and set eye.nearest_m "
                                                   "to that. ",
                                                   std::ceil(100.0 * *comfortable_m) / 100.0)
                                     : "",
                       std::floor(eye.interocular_mm * settings::comfortable_parallax_rad / parallax_rad));
}

void judge_stereo(const settings::Settings& settings, Page& page) {
    const settings::Stereo stereo = settings::stereo_of(settings);
    if (stereo == settings::Stereo::Off) {
        return;
    }
    const double parallax_rad = settings::largest_parallax_rad(settings, settings.eye.nearest_m);
    page.text += fmt::format("  In stereo ({}), a point at the far side of the prop has a parallax of up to "
                             "{:.2f} degrees against the face that shows it, for eyes {:g} m from the prop "
                             "(eye.nearest_m).\n",
                             settings::name_of(stereo), glm::degrees(parallax_rad), settings.eye.nearest_m);
    if (parallax_rad > settings::comfortable_parallax_rad) {
        page.faults.push_back(parallax_fault(settings, parallax_rad));
    }
    constexpr double steady_hz = 100.0; // 50 pictures a second for each eye
    if (stereo == settings::Stereo::FrameSequential && settings.projector.refresh_hz < steady_hz) {
        page.faults.push_back(fmt::format("Frame-sequential stereo flickers: each eye sees {:g} pictures a "
                                          "second, and needs 50. Take a mode of the projector with "
                                          "projector.refresh_hz = 100 or more, or another layout.",
                                          0.5 * settings.projector.refresh_hz));
    }
}

/// Over which depth the picture is sharp; for a prop in the hand, whether all of its zone is.
void judge_focus(const settings::Settings& settings, Page& page) {
    const std::optional<settings::DepthRange> lit = settings::lit_depths(settings);
    if (!lit) {
        return; // setup_page says that the prop fits nowhere
    }
    const settings::ProjectorSettings& projector = settings.projector;
    const double focus_m = lit->middle_m();
    const settings::DepthRange sharp = settings::sharp_depths(projector, focus_m);
    page.text += fmt::format("  Focused at {:.3f} m, the middle of what is lit, the picture blurs by less "
                             "than a pixel from {:.3f} m {} "
                             "in front of the lens (projector.aperture_mm = {:g}).\n",
                             focus_m, sharp.nearest_m,
                             std::isfinite(sharp.farthest_m) ? fmt::format("to {:.3f} m", sharp.farthest_m)
                                                             : std::string("on"),
                             projector.aperture_mm);
    if (settings.prop.zone != settings::PropZone::Hand) {
        return;
    }
    const double blur = settings::blur_px(projector, focus_m, lit->nearest_m);
    const std::string zone =
        fmt::format("the zone of the hand, {:.3f} to {:.3f} m", lit->nearest_m, lit->farthest_m);
    page.text += blur < 1.0
                     ? fmt::format("  All of {}, is sharp: the blur is {:.2f} pixels at most.\n", zone, blur)
                     : fmt::format("  Not all of {}, is sharp: at its near end the blur is {:.1f} pixels; an "
                                   "aperture of {:.2g} "
                                   "mm or less keeps it below one.\n",
                                   zone, blur, settings::largest_aperture_mm(projector, *lit));
}

void judge_words(const settings::Settings& settings, const std::vector<NamedPack>& packs, Page& page) {
    if (settings.exhibit.words.empty()) {
        page.text += "  The exhibit has no words of its own: exhibit.words is left out.\n";
        return;
    }
    const Result<std::vector<pack::WordsLanguage>> listed =
        read_file(settings.exhibit.words).and_then([](const Bytes& file) { return pack::list_words(file); });
    if (!listed) {
        page.text += "  exhibit.words cannot be read, and is not judged.\n";
        return;
    }
    std::vector<std::string> there;
    std::transform(listed->begin(), listed->end(), std::back_inserter(there),
                   [](const pack::WordsLanguage& language) { return language.language; });
    page.text += fmt::format("  The exhibit's own words are in {}.\n", fmt::join(there, ", "));
    std::vector<std::string> wanted{settings.exhibit.language};
    for (const NamedPack& pack : packs) {
        for (const std::string& language : pack.entry.languages) {
            exhibit::add_language(wanted, language);
        }
    }
    std::vector<std::string> missing;
    std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(missing),
                 [&](const std::string& language) { return !exhibit::has_language(there, language); });
    if (missing.empty()) {
        return;
    }
    const std::string instead = there[exhibit::caption_for(missing.front(), there)];
    std::vector<std::string> all = there;
    all.insert(all.end(), missing.begin(), missing.end());
    page.faults.push_back(
        fmt::format("The exhibit's own words lack {}: visitors who read captions in it are invited and "
                    "advised in {}. Bake them: frustumscreen-bake --words --languages {} -o {}.",
                    fmt::join(missing, ", "), instead, fmt::join(all, ","), settings.exhibit.words.string()));
}

void judge_language(const settings::Settings& settings, const std::vector<NamedPack>& packs, Page& page) {
    const bool has = packs.empty() || std::any_of(packs.begin(), packs.end(), [&](const NamedPack& pack) {
                         return exhibit::has_language(pack.entry.languages, settings.exhibit.language);
                     });
    if (!has) {
        page.faults.push_back(
            fmt::format("No artifact has captions in exhibit.language, {}.", settings.exhibit.language));
    }
}

} // namespace

std::string judgement_page(const settings::Settings& settings, std::chrono::sys_seconds now) {
    const std::vector<NamedPack> packs = named_packs(settings);
    Page page;
    page.text = "The visitors' view\n";
    if (const std::size_t unread = settings.exhibit.packs.size() - packs.size(); unread > 0) {
        page.text += fmt::format("  {} of {} packs cannot be read, and are not judged.\n", unread,
                                 settings.exhibit.packs.size());
    }
    const settings::Rectangle zone = judge_zone(settings, packs, page);
    judge_focus(settings, page);
    judge_letters(settings, page);
    judge_stereo(settings, page);
    judge_caption_room(settings, packs, zone, page);
    judge_words(settings, packs, page);
    judge_language(settings, packs, page);
    page.text += week_page(settings.hours, now, local_offset_at);
    page.text += "To check\n";
    for (const std::string& fault : page.faults) {
        page.text += "  " + fault + "\n";
    }
    return page.text + (page.faults.empty() ? "  Nothing.\n" : "");
}

} // namespace frustumscreen::programs

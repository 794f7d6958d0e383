/// What the projector shows a technician during a calibration, and says: by touch or its touch-up the cross, how the prop is to lie on it; by a camera
/// where the board is to stand next, while no stripes are shown; by eye where the prop is to lie, the cross behind it, which of its corners is to
/// cover that; and what to do.
///
/// Light    by a camera the ground is grey and not black, so that it sees the tags meanwhile. By eye the corner is lit by a dot, and an arrow on the
///          prop's top leads to it.
/// Aim      the prop covers its cross: the arms reach out from under it, and a square shows where it stands. Marks in the middles of its bottom
///          edges are laid on the arms.
/// Units    pixels of the projector's picture.
/// Words    in English, as in the alignment pattern; above them one sentence in the house's language, where that is another one. By touch and by a
///          camera where the prop hides none of them; by eye beside the prop, where no cross is, as large as they fit.
/// Threads  as Canvas.
#pragma once

#include "app/calibration/procedure/auto_procedure.h"
#include "app/calibration/procedure/eye_procedure.h"
#include "app/calibration/procedure/touch_procedure.h"
#include "app/calibration/touch_up.h"
#include "app/image/image.h"
#include "app/pack/words_file.h"
#include "app/programs/calibrate/table_words.h"
#include "app/typography/text_image.h"

namespace frustumscreen {

[[nodiscard]] TableWords table_words(const TouchProcedure& procedure);
/// None while a pattern is shown.
[[nodiscard]] TableWords table_words(const AutoProcedure& procedure);
[[nodiscard]] TableWords table_words(const EyeProcedure& procedure);
/// The key of a word alone: what is amiss, else how the board is to stand next. `may_go_on`: Back leads on to the crosses.
[[nodiscard]] std::string_view key_of(AutoWord word, Posture wished, bool may_go_on);
/// What came of a technician's touches, in words for the table and as the way through them needs it.
[[nodiscard]] TouchJudgement judgement_of(const TouchCalibration& calibration);
[[nodiscard]] TouchJudgement judgement_of(const TouchUp& found);

/// What a picture is drawn with. By eye it is as large as the scene's.
struct TableDrawing {
    int width = 0, height = 0;
    double prop_px = 0.0; ///< about the width of the prop's bottom on the table
    double above_m =
        0.0; ///< about how high the projector hangs: what lies on boards is wider by that; 0: not told
    double board_px = 0.0; ///< about the width of the board
    const Typesetter& typesetter;
    const LanguageWords* house = nullptr; ///< the house's words
};
[[nodiscard]] Image8 table_picture(const TouchProcedure& procedure, const TableDrawing& with);
/// A pattern, where one is shown.
[[nodiscard]] Image8 table_picture(const AutoProcedure& procedure, const TableDrawing& with);
[[nodiscard]] Image8 table_picture(const EyeProcedure& procedure, const TableDrawing& with);

} // namespace frustumscreen

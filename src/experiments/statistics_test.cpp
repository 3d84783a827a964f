// SPDX-License-Identifier: MIT
// What views say together, the lines of results.csv, and which pictures a page keeps.
#include "experiments/statistics.h"

#include <gtest/gtest.h>

#include "experiments/page_pictures.h"
#include "experiments/results_csv.h"

namespace luxel {
namespace {

ViewResult view_of(double gain, double rho, bool claimed) {
    ViewResult view;
    view.rows.resize(2);
    for (RowResult& row : view.rows) row.passes = {{"pass", 1.0}};
    view.rows[0].figures.rho = 0.5;
    view.rows[0].figures.delta = 1.0;
    view.rows[1].figures.delta = 1.0 - gain / 100;
    view.rows[1].figures.gain = gain;
    view.rows[1].figures.rho = rho;
    view.rows[1].figures.improved = gain > 0 ? 1.0 : 0.25;
    view.rows[1].claimed = claimed;
    return view;
}

TEST(Statistics, SharesMeansAndMedians) {
    const ViewResult views[] = {view_of(-2, 0.4, false), view_of(1, 0.6, false), view_of(4, 0.8, true),
                                view_of(9, 0.6, true)};
    const Summary s = summarize({&views[0], &views[1], &views[2], &views[3]}, 1);
    EXPECT_EQ(s.views, 4);
    EXPECT_DOUBLE_EQ(s.positive, 0.75);
    EXPECT_DOUBLE_EQ(s.claimed, 0.5);
    EXPECT_DOUBLE_EQ(s.mean_gain, 3);
    EXPECT_DOUBLE_EQ(s.median_gain, 2.5);
    EXPECT_DOUBLE_EQ(s.rho_before, 0.5);
    EXPECT_DOUBLE_EQ(s.rho_after, 0.6);
    EXPECT_DOUBLE_EQ(s.improved, (0.25 + 3) / 4);
}

// One scene with `count` views whose gains are 0, 1, 2, ... and whose pictures take 1000 bytes each.
ExperimentResult result_with(int count) {
    ExperimentResult result;
    result.experiment.scenes.resize(1);
    result.experiment.scenes[0].name = "a \"quoted\", scene";
    result.rows = {{"direct", "direct", {}},
                   {"isr:samples=3", "isr", {{.name = "samples", .type = "integer", .value = "3"}}}};
    result.scenes.resize(1);
    std::vector<const ViewResult*> views;
    for (int i = 0; i < count; ++i) {
        result.scenes[0].views.push_back(view_of(i, 0.5, true));
        result.scenes[0].views.back().pictures = {{"reference", std::string(1000, 'x')}};
    }
    for (const ViewResult& view : result.scenes[0].views) views.push_back(&view);
    result.mean = mean_rows(views);
    return result;
}

TEST(Statistics, LinesOfTheTable) {
    const std::string csv = results_csv(result_with(2));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
    EXPECT_TRUE(csv.starts_with("scene,group,view,width,height,label,technique,isr.samples,delta,gain,"));
    EXPECT_NE(csv.find("\n\"a \"\"quoted\"\", scene\",,,0,0,direct,direct,,1,"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",isr:samples=3,isr,3,"), std::string::npos) << csv;
}

TEST(Statistics, APageKeepsAsManyPicturesAsFitFromTheWorstToTheBest) {
    const ExperimentResult result = result_with(100);
    const auto held = [&](std::size_t limit) {
        std::vector<int> views;
        const nlohmann::ordered_json pictures = page_pictures(result, limit);
        for (int i = 0; i < 100; ++i)
            if (!pictures[0][std::size_t(i)].is_null()) views.push_back(i);
        return views;
    };
    EXPECT_EQ(held(100000).size(), 100u);
    EXPECT_EQ(held(4000), (std::vector<int>{0, 33, 66, 99}));
}

} // namespace
} // namespace luxel

// SPDX-License-Identifier: MIT
// luxel reproduce through the command line: every number is one, and times are in proportion.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/luxel_process.h"

namespace luxel::testing {
namespace {

using Json = nlohmann::json;

Json reproduce(std::vector<std::string> arguments) {
    const TemporaryFolder cache;
    arguments.insert(arguments.begin(), "reproduce");
    for (const std::string& a :
         {std::string("--views-per-scene"), std::string("1"), std::string("--size"), std::string("48x36"),
          std::string("--spp"), std::string("8"), std::string("--cache"), cache.path().string(),
          std::string("--quiet"), std::string("--json")})
        arguments.push_back(a);
    const ProcessResult result = run_luxel(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    return Json::parse(result.out, nullptr, false);
}

bool contains(const Json& statement, const std::string& part) {
    return statement.at("subject").get<std::string>().find(part) != std::string::npos;
}

// JSON has no NaN and no infinity: null where a number is expected.
void expect_finite(const Json& result) {
    for (const Json& statement : result.at("statements")) {
        EXPECT_FALSE(statement.at("values").empty()) << statement;
        for (const Json& value : statement.at("values")) {
            ASSERT_TRUE(value.is_number()) << statement;
            EXPECT_TRUE(std::isfinite(value.get<double>())) << statement;
        }
    }
}

TEST(Reproduce, RadiosityHasVerdictsOnSignsAndOrdersAlone) {
    const Json result = reproduce({"rohleder-2010", "--scene", "builtin:cornell", "--frames", "3"});
    ASSERT_EQ(result.at("statements").size(), 14u);
    expect_finite(result);
    for (const Json& statement : result.at("statements")) {
        const bool number_alone =
            contains(statement, "improved") || contains(statement, "cost") || contains(statement, "share");
        EXPECT_EQ(statement.at("holds").is_null(), number_alone) << statement;
        if (contains(statement, "cost")) {
            EXPECT_GT(statement.at("values")[0], 0.0) << statement;
        }
        if (contains(statement, "share of the frame")) {
            EXPECT_GT(statement.at("values")[0], 0.0) << statement;
            EXPECT_LT(statement.at("values")[0], 100.0) << statement;
        }
    }
}

TEST(Reproduce, OcclusionHasRatiosOfTimesThatAreInProportion) {
    const std::vector<std::string> once = {"umenhoffer-2009",      "--chapter", "4", "--scene",
                                           "builtin:shapes-point", "--frames",  "1"};
    const Json result = reproduce(once);
    ASSERT_EQ(result.at("statements").size(), 29u); // 6 truths x 4 orders, 4 times, the normalization
    expect_finite(result);
    int ratios = 0;
    for (const Json& statement : result.at("statements")) {
        if (!contains(statement, "time of")) {
            EXPECT_TRUE(statement.at("holds").is_boolean()) << statement;
            continue;
        }
        ++ratios;
        EXPECT_TRUE(statement.at("holds").is_null()) << statement; // of one frame there is no median
        for (const Json& value : statement.at("values")) {
            EXPECT_GT(value, 0.01) << statement;
            EXPECT_LT(value, 100.0) << statement;
        }
    }
    EXPECT_EQ(ratios, 4);
}

TEST(Reproduce, PhotonsHaveTimesByScene) {
    const Json result = reproduce({"le-2014", "--scene", "builtin:ring", "--frames", "1"});
    ASSERT_EQ(result.at("statements").size(), 12u); // 4 times, 4 leaks, 4 by the frame's size
    expect_finite(result);
    for (const Json& statement : result.at("statements")) {
        EXPECT_TRUE(statement.at("holds").is_null()) << statement;
        const double value = statement.at("values")[0];
        if (contains(statement, "where the truth has none")) {
            EXPECT_GE(value, 0.0) << statement;
            EXPECT_LT(value, 20.0) << statement << ": everything is seen here";
        } else {
            EXPECT_GT(value, 0.05) << statement;
            EXPECT_LT(value, 200.0) << statement;
        }
    }
}

} // namespace
} // namespace luxel::testing

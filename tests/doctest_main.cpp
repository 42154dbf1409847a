// SPDX-License-Identifier: MIT
// The entry point of every doctest program here. Unlike doctest's own, it fails when a filter
// matches no test case, or when not one assertion was checked: a test that ran nothing has proved
// nothing.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

namespace {

bool anything_checked = false;

struct AssertionCounter final : doctest::IReporter {
  explicit AssertionCounter(const doctest::ContextOptions& /*options*/) {}

  void report_query(const doctest::QueryData& /*data*/) override { anything_checked = true; }
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats& stats) override {
    anything_checked = stats.numTestCasesPassingFilters > 0 && stats.numAsserts > 0;
  }
  void test_case_start(const doctest::TestCaseData& /*data*/) override {}
  void test_case_reenter(const doctest::TestCaseData& /*data*/) override {}
  void test_case_end(const doctest::CurrentTestCaseStats& /*stats*/) override {}
  void test_case_exception(const doctest::TestCaseException& /*exception*/) override {}
  void subcase_start(const doctest::SubcaseSignature& /*signature*/) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData& /*data*/) override {}
  void log_message(const doctest::MessageData& /*data*/) override {}
  void test_case_skipped(const doctest::TestCaseData& /*data*/) override {}
};

}  // namespace

DOCTEST_REGISTER_LISTENER("assertion_counter", 1, AssertionCounter);

int main(int argc, char** argv) {
  doctest::Context context;
  context.applyCommandLine(argc, argv);
  const int status = context.run();
  if (context.shouldExit()) return status;
  if (!anything_checked) {
    std::fputs("No assertion was checked: the filter matches no test case, or the test is empty.\n",
               stderr);
    return EXIT_FAILURE;
  }
  return status;
}

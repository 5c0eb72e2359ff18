#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Count the test cases in a folder of JUnit results: prints "PASSED FAILED SKIPPED FILES_WITH_FAILURES".

catkin_test_results gives a verdict, but no count: it adds the totals of nested suites, so that gtest's cases count
twice, and it counts each program that rostest runs (rostest-*.xml) besides that program's cases (rosunit-*.xml).
Here the former counts only if it failed: the program died or ran out of time.
The names of failed cases go to standard error.
"""
import pathlib
import sys
import xml.etree.ElementTree


def outcome(case):
    """How a <testcase> ended: "passed", "failed" or "skipped"."""
    if case.find("failure") is not None or case.find("error") is not None:
        return "failed"
    if case.find("skipped") is not None or case.get("status") == "notrun" or case.get("result") == "skipped":
        return "skipped"
    return "passed"


def main(results_dir):
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    files_with_failures = 0
    for path in sorted(pathlib.Path(results_dir).rglob("*.xml")):
        cases = xml.etree.ElementTree.parse(path).getroot().findall(".//testcase")
        failed = [case for case in cases if outcome(case) == "failed"]
        if path.name.startswith("rostest-"):
            cases = failed
        for case in cases:
            counts[outcome(case)] += 1
        for case in failed:
            print(f"FAILED {path.stem}: {case.get('classname')}.{case.get('name')}", file=sys.stderr)
        files_with_failures += bool(failed)
    print(counts["passed"], counts["failed"], counts["skipped"], files_with_failures)


if __name__ == "__main__":
    main(sys.argv[1])

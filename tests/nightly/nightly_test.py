#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""tools/nightly with steps that take a moment. Argument: source folder."""
import contextlib
import html.parser
import io
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "tools/python"))
from nightly_run import GRACE_S, Step, main
import nightly_steps


def step(name, script, minutes=1.0, by_default=True):
    return Step(name, minutes, ("bash", "-c", script), f"about {name}", by_default)


class Tags(html.parser.HTMLParser):
    """The tags, links and text of a page."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.links, self.text = set(), [], ""
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.links += [value for key, value in attributes if key == "href"]

    def handle_data(self, data):
        self.text += data


class Nightly(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name) / "night"

    def run_main(self, words, steps):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = main(words, "about", lambda: steps, self.folder)
            except SystemExit as exit_:
                code = exit_.code
        return code, out.getvalue(), err.getvalue()

    def page(self):
        return Tags((self.folder / "index.html").read_text(encoding="utf-8"))

    def results(self, steps):
        return {one.name: one.result for one in steps}

    def test_failing_steps_do_not_stop_the_others(self):
        steps = [step("first", "echo good"), step("second", "echo bad; exit 3"), step("third", "kill -9 $$"),
                 Step("fourth", 1, ("no/such/program",), "missing"), step("fifth", "echo end")]
        code, _, _ = self.run_main([], steps)
        self.assertEqual(code, 1)
        self.assertEqual(self.results(steps), {"first": "passed", "second": "exit code 3", "third": "signal 9",
                                               "fourth": "not started", "fifth": "passed"})
        page = self.page()
        self.assertIn("2 of 5 steps passed, 3 failed, 0 left out", page.text)
        self.assertEqual(page.links, [f"{one.name}.log" for one in steps])
        self.assertEqual((self.folder / "second.log").read_text(), "bad\n")
        self.assertIn("no/such/program", (self.folder / "fourth.log").read_text())

    def test_all_passed_is_zero_and_logs_of_the_night_before_are_gone(self):
        self.assertEqual(self.run_main([], [step("old", "true")])[0], 0)
        self.assertEqual(self.run_main([], [step("new", "true")])[0], 0)
        self.assertFalse((self.folder / "old.log").exists())

    def test_limits_end_a_step_with_its_children(self):
        steps = [step("slow", "sleep 60 & echo $!; wait", minutes=0.5 / 60), step("next", "true")]
        start = time.monotonic()
        self.assertEqual(self.run_main([], steps)[0], 1)
        self.assertLess(time.monotonic() - start, 0.5 + GRACE_S)
        self.assertEqual(self.results(steps), {"slow": "ended after 0:00:00", "next": "passed"})
        child = pathlib.Path(f"/proc/{(self.folder / 'slow.log').read_text().strip()}/stat")
        for _ in range(100):
            if not child.exists() or child.read_text().rsplit(")", 1)[1].split()[0] == "Z":
                return
            time.sleep(0.05)
        self.fail("the child of a step still runs")

    def test_a_step_that_ignores_sigterm_is_killed(self):
        self.addCleanup(setattr, sys.modules["nightly_run"], "GRACE_S", GRACE_S)
        sys.modules["nightly_run"].GRACE_S = 0.2
        steps = [step("stubborn", "trap '' TERM; while true; do sleep 0.05; done", minutes=0.3 / 60)]
        self.run_main([], steps)
        self.assertTrue(steps[0].failed)

    def test_what_remains_when_the_hours_are_over_is_left_out(self):
        steps = [step("long", "sleep 60"), step("rest", "true")]
        code, _, _ = self.run_main(["--hours", "0.0002"], steps)
        self.assertEqual((code, steps[1].result), (1, "no time left"))
        self.assertTrue(steps[0].failed)
        self.assertFalse((self.folder / "rest.log").exists())
        self.assertEqual(self.run_main(["--hours", "11"], steps)[0], 2)

    def test_output_is_text_on_the_page(self):
        script = r"printf '<script>alert(1)</script> & \033]0;x\007 \377 <img src=x>\n'; exit 1"
        self.run_main([], [step("hostile", script)])
        page = self.page()
        self.assertTrue({"script", "img"}.isdisjoint(page.tags))
        self.assertIn("<script>alert(1)</script> & ", page.text)
        self.assertIsNone(re.search(r"[\x00-\x09\x0b-\x1f\x7f]", page.text))

    def test_only_and_list(self):
        def steps():
            return [step("a-1", "true"), step("a-2", "true"), step("b", "false"), step("rare", "true", by_default=False)]
        some = steps()
        self.assertEqual(self.run_main(["--only", "a-*", "--only", "rare"], some)[0], 0)
        self.assertEqual([one.result for one in some], ["passed", "passed", "waiting", "passed"])
        usual = steps()
        self.run_main([], usual)
        self.assertEqual(usual[3].result, "waiting")
        code, _, err = self.run_main(["--only", "c"], steps())
        self.assertEqual((code, err), (2, "tools/nightly: --only c: no such step; see --list\n"))
        code, out, _ = self.run_main(["--list"], steps())
        self.assertEqual((code, [line.split()[0] for line in out.splitlines()]), (0, ["a-1", "a-2", "b", "rare"]))

    def test_two_at_once_are_refused_and_an_interrupted_one_leaves_its_page(self):
        program = (f"import sys; sys.path.insert(0, {str(ROOT / 'tools/python')!r}); sys.dont_write_bytecode = True\n"
                   "from nightly_run import Step, main\n"
                   "sys.exit(main([], '', lambda: [Step('wait', 1, ('sleep', '60'), ''), Step('rest', 1, ('true',), '')],"
                   f" {str(self.folder)!r}))")
        with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.DEVNULL) as other:
            while not (self.folder / "wait.log").exists():
                time.sleep(0.02)
                self.assertIsNone(other.poll())
            code, _, err = self.run_main([], [step("second", "true")])
            self.assertEqual((code, "another one is running" in err), (1, True))
            other.send_signal(signal.SIGTERM)
            self.assertEqual(other.wait(), 130)
        self.assertIn("interrupted", self.page().text)
        self.assertFalse((self.folder / "rest.log").exists())

    def test_the_steps_of_the_project_have_a_preset_script_and_limit(self):
        steps = nightly_steps.all_steps()
        presets = set(re.findall(r'"name": "([a-z-]+)"', (ROOT / "CMakePresets.json").read_text()))
        for one in steps:
            self.assertRegex(one.name, r"^[A-Za-z0-9_-]+$")
            self.assertTrue(0 < one.minutes <= 600, one.name)
            self.assertTrue(set(re.findall(r"--preset ([a-z-]+)", " ".join(one.command))) <= presets, one.name)
            if one.command[0].startswith("tools/"):
                self.assertTrue(os.access(ROOT / one.command[0], os.X_OK), one.name)
        self.assertEqual(len({one.name for one in steps}), len(steps))


if __name__ == "__main__":
    unittest.main()

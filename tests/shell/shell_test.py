"""What a shell offers: man pages and completions are those of the commands that there are, and work."""

import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["BRISANCE_BINARY"]
SOURCE = pathlib.Path(os.environ["BRISANCE_SOURCE_DIR"])
SHARE = SOURCE / "share"
COMPLETION = SHARE / "bash-completion/completions/brisance"
BASH_COMPLETION = pathlib.Path("/usr/share/bash-completion/bash_completion")


def said(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True).stdout


def part(help_text, heading):
    """The indented lines below a heading of --help."""
    found = re.search(rf"^{heading}:\n((?:  .*\n?)+)", help_text, re.MULTILINE)
    return found[1] if found else ""


def commands():
    """As CLI11's own help lists them."""
    return re.findall(r"^  (\w+)", part(said("--help"), "Subcommands"), re.MULTILINE)


def options(command):
    lines = re.findall(r"^  (-\S+)", part(said(command, "--help"), "Options"), re.MULTILINE)
    return [name for line in lines for name in line.split(",")]


def page_of(command):
    return SHARE / "man/man1" / f"brisance-{command}.1"


class CommittedPages(unittest.TestCase):
    def check(self, file, *words):
        self.assertEqual(file.read_text(), said("reference", *words), f"{file}: ./dev docs writes it anew")

    def test_they_are_the_generated_ones(self):
        self.check(SOURCE / "docs/commands.md", "commands")
        self.check(COMPLETION, "completion-bash")
        self.check(SHARE / "zsh/site-functions/_brisance", "completion-zsh")
        self.check(SHARE / "fish/vendor_completions.d/brisance.fish", "completion-fish")
        self.check(SHARE / "man/man1/brisance.1", "man")
        for command in commands():
            self.check(page_of(command), "man", command)

    def test_no_page_is_left_of_a_command_that_is_gone(self):
        pages = {file.name for file in (SHARE / "man/man1").iterdir()}
        self.assertEqual(pages, {"brisance.1"} | {page_of(command).name for command in commands()})

    def test_every_command_and_option_is_in_them(self):
        self.assertGreater(len(commands()), 10)
        document = (SOURCE / "docs/commands.md").read_text()
        overview = (SHARE / "man/man1/brisance.1").read_text()
        for command in commands():
            self.assertIn(f"\\fB{command}\\fR", overview)
            page = page_of(command).read_text().replace("\\-", "-")
            section = document.split(f"## brisance {command}\n")[1].split("\n## ")[0]
            self.assertGreater(len(options(command)), 3)
            for option in options(command):
                self.assertIn(f"\\fB{option}\\fR", page, command)
                self.assertRegex(section, rf"`{option}[ `]", command)

    def test_a_page_of_an_unknown_command_is_refused(self):
        ended = subprocess.run([PROGRAM, "reference", "man", "explode"], capture_output=True, text=True, check=False)
        self.assertEqual(ended.returncode, 2)
        self.assertRegex(ended.stderr, r"^brisance: explode: unknown command; must be one of run, check.*\n$")


class ManPages(unittest.TestCase):
    def warnings(self, tool, *words):
        if not shutil.which(tool):
            self.skipTest(f"{tool} is missing (packaging/docs.txt)")
        for page in sorted((SHARE / "man/man1").iterdir()):
            told = subprocess.run([tool, *words, str(page)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  text=True, check=False, env={**os.environ, "MANWIDTH": "80"})
            yield page.name, told.stdout, told.returncode

    def test_groff_has_nothing_to_warn_of(self):
        for name, told, code in self.warnings("groff", "-man", "-ww", "-z", "-Tutf8"):
            self.assertEqual((told, code), ("", 0), name)

    def test_mandoc_has_nothing_to_say(self):
        for name, told, code in self.warnings("mandoc", "-T", "lint"):
            self.assertEqual((told, code), ("", 0), name)

    def test_man_shows_them(self):
        for name, told, _ in self.warnings("man", "-l"):
            for heading in ("NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "FILES", "EXAMPLES"):
                self.assertRegex(told, rf"(?m)^{heading}$", name)


class BashCompletion(unittest.TestCase):
    """The function itself, as bash calls it."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="brisance_shell.")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for name in ("window.toml", "a scene.toml", "notes.txt", "toy.obj"):
            (self.folder / name).touch()
        (self.folder / "runs/window").mkdir(parents=True)

    def offered(self, *words):
        """What is offered for the last word."""
        script = (f"source '{COMPLETION}'; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); "
                  "_brisance brisance \"${COMP_WORDS[COMP_CWORD]}\" \"${COMP_WORDS[COMP_CWORD - 1]}\"; "
                  "((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"; true")
        told = subprocess.run(["bash", "--norc", "-euc", script, "bash", "brisance", *words], cwd=self.folder,
                              capture_output=True, text=True, check=True)
        self.assertEqual(told.stderr, "")
        return told.stdout.splitlines()

    def test_commands(self):
        self.assertEqual(self.offered(""), commands())
        self.assertEqual(self.offered("re"), ["render", "reference"])
        self.assertEqual(self.offered("--v"), ["--version"])

    def test_every_option_of_every_command(self):
        for command in commands():
            self.assertEqual(sorted(self.offered(command, "-")), sorted(options(command)), command)

    def test_options_behind_others(self):
        self.assertEqual(self.offered("render", "runs/window", "--threads", "2", "--sk"), ["--skip-existing"])
        self.assertEqual(self.offered("run", "window.toml", "--json", "--over"), ["--overwrite"])

    def test_words_that_an_option_allows(self):
        self.assertIn("vdb", self.offered("export", "runs/window", "--to", ""))
        self.assertEqual(self.offered("export", "runs/window", "--to", "us"), ["usd"])
        self.assertEqual(self.offered("export", "runs/window", "--to", "=", "us"), ["usd"])
        self.assertEqual(self.offered("export", "runs/window", "--profile", "="), ["blender"])
        self.assertEqual(self.offered("farm", "runs/window", "--engine", ""), ["slurm", "local"])
        self.assertEqual(self.offered("fracture", "toy.obj", "--method", "c"), ["curvature"])
        self.assertEqual(self.offered("reference", "completion-"),
                         ["completion-bash", "completion-zsh", "completion-fish"])

    def test_numbers_are_left_to_people(self):
        self.assertEqual(self.offered("render", "runs/window", "--threads", ""), [])

    def test_files_that_fit(self):
        self.assertEqual(sorted(self.offered("run", "")), ["a scene.toml", "runs", "window.toml"])
        self.assertEqual(sorted(self.offered("fracture", "")), ["a scene.toml", "runs", "toy.obj", "window.toml"])
        self.assertEqual(self.offered("render", "r"), ["runs"])
        self.assertEqual(self.offered("render", "runs/"), ["runs/window"])
        self.assertEqual(self.offered("farm", "runs/window", "--scene", "w"), ["window.toml"])
        self.assertEqual(self.offered("simulate", "window.toml", "-o", "ru"), ["runs"])
        self.assertEqual(self.offered("export", "runs/window", "--to", "obj", "-o", "n"), ["notes.txt"])


class OtherShells(unittest.TestCase):
    def accepts(self, shell, *words):
        if not shutil.which(shell):
            self.skipTest(f"{shell} is missing")
        told = subprocess.run([shell, *words], capture_output=True, text=True, check=False, cwd=SOURCE)
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        return told.stdout

    def test_zsh_reads_its_completion(self):
        self.accepts("zsh", "-n", SHARE / "zsh/site-functions/_brisance")

    def test_fish_completes(self):
        file = SHARE / "fish/vendor_completions.d/brisance.fish"
        with tempfile.TemporaryDirectory() as home:
            os.environ["XDG_CONFIG_HOME"] = os.environ["XDG_DATA_HOME"] = home
            told = self.accepts("fish", "--no-config", "-c", f"source {file}; complete -C 'brisance export x --to '")
        self.assertEqual({line.split("\t")[0] for line in told.splitlines()} >= {"gltf", "usd", "vdb"}, True, told)


class Links(unittest.TestCase):
    """./dev link, and a person at an interactive bash afterwards."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="brisance_shell.")
        self.addCleanup(scratch.cleanup)
        self.home = pathlib.Path(scratch.name)
        self.prefix = self.home / ".local"
        self.environment = {"HOME": str(self.home), "PREFIX": str(self.prefix), "TERM": "dumb", "LC_ALL": "C.UTF-8",
                            "PATH": f"{self.prefix}/bin:/usr/bin:/bin"}

    def dev(self, word):
        return subprocess.run([SOURCE / "dev", word], env=self.environment, capture_output=True, text=True, check=True)

    def links(self):
        return sorted(str(file.relative_to(self.prefix)) for file in self.prefix.rglob("*") if file.is_symlink())

    def test_man_finds_the_page(self):
        self.assertIn(str(self.prefix), self.dev("link").stderr)
        if not shutil.which("man"):
            self.skipTest("man is missing (packaging/docs.txt)")
        told = subprocess.run(["man", "-w", "brisance", "brisance-render"], env=self.environment, capture_output=True,
                              text=True, check=True)
        self.assertEqual([pathlib.Path(line).name for line in told.stdout.split()], ["brisance.1", "brisance-render.1"])

    def test_links_can_be_made_twice_and_removed(self):
        self.dev("link")
        made = self.links()
        self.assertIn("bin/brisance", made)
        self.assertIn("share/bash-completion/completions/brisance", made)
        self.dev("link")
        self.assertEqual(self.links(), made)
        self.dev("unlink")
        self.assertEqual(self.links(), [])

    def test_what_lies_there_of_others_is_left_alone(self):
        mine = self.prefix / "share/man/man1/brisance.1"
        mine.parent.mkdir(parents=True)
        mine.write_text("mine")
        self.assertIn("left as it is", self.dev("link").stderr)
        self.dev("unlink")
        self.assertEqual(mine.read_text(), "mine")

    def test_tab_completes_in_an_interactive_bash(self):
        if not BASH_COMPLETION.exists():
            self.skipTest("bash-completion is missing (packaging/docs.txt)")
        self.dev("link")
        (self.home / ".bashrc").write_text(f"source {BASH_COMPLETION}\nPS1='ready>'\n")
        self.assertIn("brisance export runs --to usd", self.typed("brisance exp\truns --to u\t"))

    def typed(self, text):
        """What an interactive bash shows once this was typed."""
        child, terminal = pty.fork()
        if child == 0:
            os.chdir(self.home)
            os.execve("/bin/bash", ["bash", "-i"], self.environment)
        shown = b""
        try:
            shown = self.until(terminal, b"ready>", shown)
            for key in text.split("\t"):
                os.write(terminal, key.encode())
                if key != text.split("\t")[-1]:
                    os.write(terminal, b"\t")
                    shown += self.settled(terminal)
            return (shown + self.settled(terminal)).decode(errors="replace").replace("\a", "")
        finally:
            os.write(terminal, b"\x15exit\n")
            os.close(terminal)
            os.waitpid(child, 0)

    def until(self, terminal, wanted, shown):
        end = time.monotonic() + 60
        while wanted not in shown and time.monotonic() < end:
            if select.select([terminal], [], [], 1)[0]:
                shown += os.read(terminal, 4096)
        self.assertIn(wanted, shown)
        return shown

    @staticmethod
    def settled(terminal):
        """Everything until nothing comes for two seconds."""
        shown = b""
        while select.select([terminal], [], [], 2)[0]:
            shown += os.read(terminal, 4096)
        return shown


if __name__ == "__main__":
    unittest.main()

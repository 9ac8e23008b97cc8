"""docs/ as a site: it is built without a warning, its links lead somewhere, and it names every key of a scene."""

import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import urllib.parse

PROGRAM = os.environ["BRISANCE_BINARY"]
SOURCE = pathlib.Path(os.environ["BRISANCE_SOURCE_DIR"])


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.loaded = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.ids.add(named.get("id"))
        if tag == "a" and "href" in named:
            self.links.append(named["href"])
        if tag in ("img", "script") and "src" in named:
            self.loaded.append(named["src"])
        if tag == "link" and named.get("rel") != "canonical":
            self.loaded.append(named["href"])


def keys_of(schema, path=""):
    """Paths of all keys, as the reference writes them: name[] is an array of tables."""
    for kind in schema.get("anyOf", []):
        yield from keys_of(kind, path)
    if "items" in schema:
        yield from keys_of(schema["items"], path + "[]")
    for name, inner in schema.get("properties", {}).items():
        key = f"{path}.{name}" if path else name
        below = list(keys_of(inner, key))
        yield from below or [key]


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not shutil.which("mkdocs") or not pathlib.Path("/usr/share/mkdocs/themes/material").exists():
            raise unittest.SkipTest("mkdocs or its theme is missing (packaging/docs.txt)")
        scratch = tempfile.TemporaryDirectory(prefix="brisance_site.")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        cls.built = subprocess.run(["mkdocs", "build", "--strict", "--clean", "--site-dir", scratch.name], cwd=SOURCE,
                                   capture_output=True, text=True, check=False)
        cls.pages = {file.name: Page(file.read_text()) for file in cls.folder.glob("*.html") if file.name != "404.html"}

    def test_it_is_built_without_a_warning(self):
        self.assertEqual(self.built.returncode, 0, self.built.stderr)
        self.assertNotIn("WARNING", self.built.stderr)
        self.assertNotIn("not included in the \"nav\"", self.built.stderr)

    def test_every_document_is_a_page(self):
        self.assertEqual({f"{file.stem}.html" for file in (SOURCE / "docs").glob("*.md")}, set(self.pages))

    def test_every_link_leads_somewhere(self):
        for name, page in self.pages.items():
            for link in page.links + page.loaded:
                where = urllib.parse.urlparse(link)
                if where.scheme or where.netloc:
                    continue
                target = where.path.rstrip("/") or name
                self.assertTrue((self.folder / urllib.parse.unquote(target)).exists() or target == ".", f"{name}: {link}")
                if where.fragment and target in self.pages and where.fragment != "__consent":
                    self.assertIn(urllib.parse.unquote(where.fragment), self.pages[target].ids, f"{name}: {link}")

    def test_no_page_loads_anything_from_elsewhere(self):
        for name, page in self.pages.items():
            self.assertEqual([link for link in page.loaded if urllib.parse.urlparse(link).netloc], [], name)

    def test_the_reference_names_every_key_of_the_schema(self):
        schema = subprocess.run([PROGRAM, "reference", "schema"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(schema, (SOURCE / "docs/scene.schema.json").read_text(), "./dev docs writes it anew")
        keys = set(keys_of(json.loads(schema)))
        self.assertGreater(len(keys), 200)
        named = set(re.findall(r"<code>([\w.\[\]]+)</code>", (self.folder / "parameters.html").read_text()))
        self.assertEqual(keys - named, set())


if __name__ == "__main__":
    unittest.main()

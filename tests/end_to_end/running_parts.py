"""What of a page a browser would run: scripts, and whatever was smuggled in besides."""
import html.parser


class RunningParts(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.scripts, self.trouble = 0, []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.scripts += tag == "script"
        for name, value in attrs:
            if name.startswith("on") or (name == "src" and not value.startswith("data:")) or tag == "b" and attrs:
                self.trouble.append((tag, name, value))


def require_harmless(text, words, scripts=1):
    found = RunningParts(text)
    if found.scripts > scripts or found.trouble:
        raise AssertionError(f"{words}: {found.scripts} scripts, {found.trouble}")

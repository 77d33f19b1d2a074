"""Names as plug-ins have them."""
import os
import re
import unicodedata
from typing import Any


def kebab(name: str) -> str:
    """A name in kebab-case: DampedPendulum and damped_pendulum are damped-pendulum. Accents and signs are left out.

    >>> kebab("DampedPendulum"), kebab("my_rule"), kebab("<lambda>")
    ('damped-pendulum', 'my-rule', 'lambda')
    """
    words = "".join("-" + c if c.isupper() and k and not name[k - 1].isupper() else c for k, c in enumerate(name))
    ascii_words = unicodedata.normalize("NFKD", words).encode("ascii", "ignore").decode().lower()
    return re.sub("[^a-z0-9]+", "-", ascii_words).lstrip("-0123456789").rstrip("-") or "unnamed"


def absolute(name: Any) -> Any:
    """A name as it is, and the path of a file, which is one from the working directory, made absolute."""
    return os.path.abspath(name) if isinstance(name, os.PathLike) or isinstance(name, str) and name.endswith(".toml") else name

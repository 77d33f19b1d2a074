"""Names as plug-ins have them."""
import os
from typing import Any


def kebab(name: str) -> str:
    """A name in kebab-case: DampedPendulum and damped_pendulum are damped-pendulum.

    >>> kebab("DampedPendulum"), kebab("my_rule")
    ('damped-pendulum', 'my-rule')
    """
    words = "".join("-" + c if c.isupper() and k and not name[k - 1].isupper() else c for k, c in enumerate(name))
    return words.lower().replace("_", "-").strip("-")


def absolute(name: Any) -> Any:
    """A name as it is, and the path of a file, which is one from the working directory, made absolute."""
    return os.path.abspath(name) if isinstance(name, os.PathLike) or isinstance(name, str) and name.endswith(".toml") else name

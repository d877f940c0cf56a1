"""What a package needs that adds a command to ``turgor``, in the same manners: errors as sentences, JSON, exit codes.

Such a package names its command, or its group of commands, as an entry point of the group ``turgor.commands``. The
entry point is a function with the annotations of typer, or a ``typer.Typer``.
"""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.cli.exits import BAD_INPUT as BAD_INPUT
    from turgor.cli.exits import DONE as DONE
    from turgor.cli.exits import FOUND_ERROR as FOUND_ERROR
    from turgor.cli.exits import NOT_CONVERGED as NOT_CONVERGED
    from turgor.cli.exits import errors_as_sentences as errors_as_sentences
    from turgor.cli.options import Debug as Debug
    from turgor.cli.options import Json as Json
    from turgor.cli.options import Retry as Retry
    from turgor.cli.options import output_option as output_option
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())

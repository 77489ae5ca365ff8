"""How much a visitor may upload: viser keeps whatever is announced, and whatever comes, until it is whole."""

import viser
from viser import _messages

LARGEST_UPLOAD = 16 * 2**20  # bytes of all unfinished uploads of a visitor; a file of settings has about a thousand


class UploadLimit:
    """Looks at the messages of uploads before viser does.

    Args:
        server: viser's.
    """

    def __init__(self, server: viser.ViserServer) -> None:
        self._waiting = server.gui._current_file_upload_states

    def refusal(self, client_id: int, message: _messages.Message) -> str | None:
        """Why a message is not to be obeyed; None when it may be.

        Args:
            client_id: who sent it.
            message: of any kind.
        """
        if isinstance(message, _messages.FileTransferStartUpload):
            begun = [state["total_bytes"] for state in self._waiting.values() if state["client_id"] == client_id]
            if message.size_bytes + sum(begun) > LARGEST_UPLOAD:
                return (
                    f"{message.filename} has {message.size_bytes} bytes: up to {LARGEST_UPLOAD} can be uploaded at once"
                )
        if isinstance(message, _messages.FileTransferPart):
            state = self._waiting.get(message.transfer_uuid)
            if state is not None and state["transferred_bytes"] + len(message.content) > state["total_bytes"]:
                self._waiting.pop(message.transfer_uuid, None)
                return f"{state['filename']} is longer than it was said to be"
        return None

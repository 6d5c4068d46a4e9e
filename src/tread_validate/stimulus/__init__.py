"""From one block's forces to the excitation of a tyre: pitch sequence, whole patch, spectrum, response."""

from .pitch import PitchSequence, RibBlocks, load_pitch_sequence
from .response import Response, TransferFunction, read_impulse_response, read_transfer_function, respond
from .stimulus import Stimulus, superpose

__all__ = [
    "PitchSequence",
    "Response",
    "RibBlocks",
    "Stimulus",
    "TransferFunction",
    "load_pitch_sequence",
    "read_impulse_response",
    "read_transfer_function",
    "respond",
    "superpose",
]

"""Reports as HTML pages with pictures: the paper's figures reproduced, an identification, a diagnosis.

Nothing is imported here: the reproduction needs the extras of identification and formats, the page of a diagnosis does not.
"""

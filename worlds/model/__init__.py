"""The paper's model with something around it: what challenge and workshop hide acts before, within and after its march.

march  the kernel over a motion, in one go, with acts upon its volumes, or on a mount
run    one record on its way from the motion of the rig to the channels
"""

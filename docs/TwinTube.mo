within ;
model TwinTube "Twin-tube damper between two flanges, around the imported co-simulation FMU"
  extends Modelica.Mechanics.Translational.Interfaces.PartialCompliant;
  parameter Modelica.Units.SI.Position s_rel0 = 0 "Distance of the flanges in the middle position of the damper (stroke 0)";
  parameter Real oil_level(min = 0, max = 1) = 1 "Oil in the damper, share of the intact volume";
  parameter Real gas_preload(min = 0, max = 1) = 1 "Gas pressure above ambient, share of the nominal";
  parameter Modelica.Units.SI.Temperature T = 296.15 "Temperature of oil, seals and gas; at 296.15 K the parameters hold";
  parameter Modelica.Units.SI.Time step = 1e-3 "Communication step of the FMU";
  Modelica.Units.SI.Velocity v_rel "Velocity, positive in rebound";
  twintube_SA8_fmu fmu(
    oil_level = oil_level,
    gas_preload = gas_preload,
    fmi_CommunicationStepSize = step) "The FMU as the tool imported it";
equation
  v_rel = der(s_rel);
  // Rebound lengthens the damper: flange_b is the end that moves in positive direction.
  fmu.stroke = s_rel - s_rel0;
  fmu.velocity = v_rel;
  fmu.temperature = T;
  // Positive where it pulls the flanges together, as the force of Modelica's Damper is.
  f = fmu.force;
  annotation(Documentation(info = "<html><p>flange_a is the wheel's end, flange_b the body's. The force belongs to the end of the
last communication step and is held until the next one ends. The masses at both flanges have to be there: the element
has no inertia.</p></html>"));
end TwinTube;
